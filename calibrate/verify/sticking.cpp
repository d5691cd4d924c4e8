#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/base/statistics.h"
#include "calibrate/verify/formulas.h"

namespace pastefit {

namespace {

// Closed forms of adhesive contacts, independent of the engine (core/laws): attraction less repulsion at a gap,
// negative in overlap [N]; pull-off force of the pair [N]; work of separation [J]. For a wall, its share of the
// grains' attraction counts.
//
// JKR (Johnson, Kendall & Roberts 1971): F = 4 E* a^3/(3 R*) - 4 sqrt(pi gamma E*) a^(3/2), d = a^2/R* - sqrt(4 pi
// gamma a/E*), by bisection. DMT: F = 4/3 E* sqrt(R*) d^(3/2) - 4 pi gamma R*. SJKR: the same repulsion less 2 pi k R*
// d. Requirements: a pair; gamma or k > 0. Errors: JKR at a gap beyond the range of a contact.

using std::numbers::pi;

double overlap_of(const Approach& pair, double gamma, double patch) {
  return patch * patch / pair.radius - std::sqrt(4 * pi * gamma * patch / pair.modulus);
}

/// Contact radius at separation under a prescribed distance [m].
double jkr_pull_off_patch(const Approach& pair, double gamma) {
  return std::cbrt(pi * gamma * pair.radius * pair.radius / (4 * pair.modulus));
}

/// Larger contact radius with this overlap, by bisection.
double patch_at(const Approach& pair, double gamma, double overlap) {
  const auto is_below = [&](double patch) { return overlap_of(pair, gamma, patch) < overlap; };
  const double least = jkr_pull_off_patch(pair, gamma);
  double high = 2 * least;
  while (is_below(high)) high *= 2;
  return bisected(least, high, is_below);
}

double jkr_pull_off_gap(const Approach& pair, double gamma) {
  return -overlap_of(pair, gamma, jkr_pull_off_patch(pair, gamma));
}

/// Attraction less repulsion [N].
double jkr_pull(const Approach& pair, double gamma, double gap) {
  const double patch = patch_at(pair, gamma, -gap);
  return 4 * std::sqrt(pi * gamma * pair.modulus) * std::pow(patch, 1.5) -
         4 * pair.modulus * std::pow(patch, 3) / (3 * pair.radius);
}

/// Work of the attraction from touch to separation [J], integrated in s; gap = end (1 - s^2) removes the root at the
/// end.
double jkr_work(const Approach& pair, double gamma) {
  const double end = jkr_pull_off_gap(pair, gamma);
  return integral([&](double s) { return 2 * s * end * jkr_pull(pair, gamma, end * (1 - s * s)); }, 0, 1);
}

double surface_energy(const Impact& scene) {
  return share_of(scene) * scene.contact.surface_energy_j_m2;
}

double energy_density(const Impact& scene) {
  return share_of(scene) * scene.contact.cohesion_energy_density_pa;
}

double hertz_push(const Approach& pair, double overlap) {
  return 4.0 / 3 * pair.modulus * std::sqrt(pair.radius) * std::pow(overlap, 1.5);
}

Result<double> jkr_force(const Impact& scene, const FormulaArguments& arguments) {
  const Approach pair = pair_of(scene);
  const double gamma = surface_energy(scene);
  if (arguments.gap_m > jkr_pull_off_gap(pair, gamma))
    return Fault{"expected.formula", "no contact reaches as far", "another gap"};
  return jkr_pull(pair, gamma, arguments.gap_m);
}

Result<double> dmt_force(const Impact& scene, const FormulaArguments& arguments) {
  const Approach pair = pair_of(scene);
  if (arguments.gap_m >= 0) return 0.0;
  return 4 * pi * surface_energy(scene) * pair.radius - hertz_push(pair, -arguments.gap_m);
}

Result<double> sjkr_force(const Impact& scene, const FormulaArguments& arguments) {
  const Approach pair = pair_of(scene);
  if (arguments.gap_m >= 0) return 0.0;
  const double area = 2 * pi * pair.radius * -arguments.gap_m;
  return energy_density(scene) * area - hertz_push(pair, -arguments.gap_m);
}

Result<double> sjkr_pull_off(const Impact& scene, const FormulaArguments&) {
  const Approach pair = pair_of(scene);
  const double ratio = pi * energy_density(scene) / pair.modulus;
  return 2.0 / 3 * std::pow(ratio, 3) * pair.modulus * pair.radius * pair.radius;
}

/// Relative speed after an elastic collision of an initially separated JKR pair; 0 if it sticks.
Result<double> speed_after_parting(const Impact& scene, const FormulaArguments&) {
  const Approach pair = pair_of(scene);
  return speed_after(pair, jkr_work(pair, surface_energy(scene)));
}

// Closed forms of one cycle of a contact with elasto-plastic adhesion (`epa`, exponent 3/2; `luding`, 1), from the
// branches of its law, independent of the engine (core/laws): loading to the overlap D, then unloading to the adhesion
// branch and along it. D is the overlap at which a held second grain reverses, or that of a start at rest; for free
// grains, that at which the loading branch has absorbed their kinetic energy. For a wall, its share of the adhesion
// counts. Requirements: a pair that approaches or overlaps; no friction.

/// One cycle of the law.
class Cycle {
 public:
  explicit Cycle(const Impact& scene) : pair_(pair_of(scene)) {
    const ContactModel& contact = scene.contact;
    exponent_ = contact.normal == NormalLaw::luding ? 1 : 1.5;
    loading_ = 4.0 / 3 * pair_.modulus * std::pow(pair_.radius, 2 - exponent_);
    plastic_ = contact.plasticity_ratio;
    const double share = share_of(scene);
    adhesion_ = share * contact.adhesion_ratio * loading_;
    const double scale = (scene.grains.size() < 2 ? 1 : 2) * pair_.radius / scene.reference_radius_m;
    pull_off_ = share * contact.cohesion_n.value_or(0) * scale * scale;
    deepest_ = deepest_overlap(scene);
  }

  /// Repulsion during separation.
  double force(double overlap) const {
    if (overlap <= 0) return 0;
    const double power = std::pow(overlap, exponent_), deepest = std::pow(deepest_, exponent_);
    return std::max(unloading() * (power - plastic_ * deepest), -adhesion_ * power) - pull_off_;
  }
  /// Work lost in the cycle; the constant pull-off does no net work.
  double lost() const {
    const double end = adhesion_begins();
    const double unloaded = unloading() * (integral(deepest_) - integral(end) -
                                           plastic_ * std::pow(deepest_, exponent_) * (deepest_ - end));
    return loading_ * integral(deepest_) - unloaded + adhesion_ * integral(end);
  }
  const Approach& pair() const { return pair_; }

 private:
  double unloading() const { return loading_ / (1 - plastic_); }
  double integral(double overlap) const { return std::pow(overlap, exponent_ + 1) / (exponent_ + 1); }
  double adhesion_begins() const {
    return deepest_ * std::pow(plastic_ / (1 + adhesion_ / unloading()), 1 / exponent_);
  }
  double deepest_overlap(const Impact& scene) const {
    if (const ImpactGrain& last = scene.grains.back(); last.held)
      return overlap_at_start(scene) + std::max(pair_.speed, 0.0) * last.turns_at_s.value_or(0);
    const double energy = 0.5 * pair_.mass * pair_.speed * pair_.speed;
    return std::pow((exponent_ + 1) * energy / loading_, 1 / (exponent_ + 1));
  }
  static double overlap_at_start(const Impact& scene) {
    const ImpactGrain& one = scene.grains[0];
    if (scene.grains.size() > 1)
      return one.radius_m + scene.grains[1].radius_m - norm(scene.grains[1].centre_m - one.centre_m);
    const Plane& plane = std::get<Plane>(scene.walls[0].shape);
    return one.radius_m - dot(one.centre_m - plane.point, plane.normal);
  }

  Approach pair_;
  double exponent_ = 1.5, loading_ = 0, plastic_ = 0, adhesion_ = 0, pull_off_ = 0, deepest_ = 0;
};

/// Relative speed after a collision without dashpot; 0 if the grains stick.
Result<double> epa_rebound_speed(const Impact& scene, const FormulaArguments&) {
  const Cycle cycle(scene);
  return speed_after(cycle.pair(), cycle.lost());
}

constexpr Formula kSticking[] = {
    {"jkr_force", jkr_force, "JKR at a gap; a negative one is an overlap; 8/3 pi gamma R* at touch"},
    {"jkr_pull_off",
     [](auto& scene, auto&) -> Result<double> { return 3 * pi * surface_energy(scene) * pair_of(scene).radius; },
     "3 pi gamma R*"},
    {"jkr_loop_area",
     [](auto& scene, auto&) -> Result<double> { return jkr_work(pair_of(scene), surface_energy(scene)); },
     "integral of JKR's force from touch to the end of the contact"},
    {"dmt_force", dmt_force, "DMT at a gap; a negative one is an overlap"},
    {"dmt_pull_off",
     [](auto& scene, auto&) -> Result<double> { return 4 * pi * surface_energy(scene) * pair_of(scene).radius; },
     "4 pi gamma R*"},
    {"sjkr_force", sjkr_force, "SJKR at a gap; a negative one is an overlap"},
    {"sjkr_pull_off", sjkr_pull_off, "2/3 pi^3 k^3 R*^2/E*^2"},
    {"speed_after_parting", speed_after_parting, "sqrt(v^2 - 2 W/m*), W the area of JKR's loop"},
    {"epa_force", [](auto& scene, auto& arguments) -> Result<double> { return -Cycle(scene).force(-arguments.gap_m); },
     "elasto-plastic adhesion on the way apart, at a gap; a negative one is an overlap"},
    {"epa_loop_area", [](auto& scene, auto&) -> Result<double> { return Cycle(scene).lost(); },
     "work lost in its cycle: loading, unloading, adhesion branch"},
    {"epa_rebound_speed", epa_rebound_speed, "sqrt(v^2 - 2 W/m*), W the area of that cycle"},
};

}  // namespace

std::span<const Formula> sticking_formulas() {
  return kSticking;
}

}  // namespace pastefit
