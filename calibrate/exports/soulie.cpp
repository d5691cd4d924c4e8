#include "calibrate/exports/soulie.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "calibrate/verify/force_curve.h"

namespace pastefit {

namespace {

constexpr int kGaps = 400;
constexpr int kVolumes = 200;

struct Sums {
  double squares = 0, largest = 0, work = 0, card_work = 0;
};

/// Differences of both curves over gaps from touch to `farthest`.
Sums compare(const ContactModel& contact, const GrainPair& pair, const SoulieBridge& bridge, double farthest) {
  Sums sums;
  for (int i = 0; i < kGaps; ++i) {
    const double gap = farthest * (i + 0.5) / kGaps;
    const double card = attraction_n(contact, pair, -gap), fitted = bridge.force_n(gap);
    sums.squares += (fitted - card) * (fitted - card) / kGaps;
    sums.largest = std::max(sums.largest, std::abs(fitted - card));
    sums.work += fitted * farthest / kGaps;
    sums.card_work += card * farthest / kGaps;
  }
  return sums;
}

}  // namespace

double SoulieBridge::rupture_gap_m() const {
  return std::cbrt(volume_m3);
}

double SoulieBridge::force_n(double gap) const {
  if (gap >= rupture_gap_m()) return 0;
  const double v = volume_m3 / (radius_m * radius_m * radius_m), ln = std::log(v);
  const double a = -1.1 * std::pow(v, -0.53), b = 0.48 - 0.0082 * ln, c = 0.078 + 0.0018 * ln;
  return std::numbers::pi * surface_tension_n_m * radius_m * (std::exp(a * gap / radius_m + b) + c);
}

SoulieFit fit_soulie(const ContactModel& contact, double radius) {
  const GrainPair pair{radius, radius, radius};
  const double reach = bridge_gaps(contact, pair).rupture_m, peak = attraction_n(contact, pair, 0);
  const double farthest = 1.5 * reach;
  SoulieFit best;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kVolumes; ++n) {
    const double rupture = reach * (0.5 + n / (kVolumes - 1.0));
    SoulieBridge bridge{radius, rupture * rupture * rupture, 1};
    double both = 0, own = 0;
    for (int i = 0; i < kGaps; ++i) {
      const double gap = farthest * (i + 0.5) / kGaps, force = bridge.force_n(gap);
      both += force * attraction_n(contact, pair, -gap);
      own += force * force;
    }
    bridge.surface_tension_n_m = both / own;
    const Sums sums = compare(contact, pair, bridge, farthest);
    if (sums.squares >= least) continue;
    least = sums.squares;
    best = {bridge, {sums.largest / peak, std::sqrt(sums.squares) / peak, sums.work / sums.card_work - 1}};
  }
  return best;
}

}  // namespace pastefit
