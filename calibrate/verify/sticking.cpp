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
};

}  // namespace

std::span<const Formula> sticking_formulas() {
  return kSticking;
}

}  // namespace pastefit
