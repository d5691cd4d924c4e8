#include <algorithm>
#include <cmath>

#include "calibrate/verify/formulas.h"

namespace pastefit {

namespace {

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
    const bool held = scene.grains.back().held;
    if (held) {
      const ImpactGrain& last = scene.grains.back();
      return overlap_at_start(scene) + std::max(pair_.speed, 0.0) * last.turns_at_s.value_or(0);
    }
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

constexpr Formula kYielding[] = {
    {"epa_force", [](auto& scene, auto& arguments) -> Result<double> { return -Cycle(scene).force(-arguments.gap_m); },
     "elasto-plastic adhesion on the way apart, at a gap; a negative one is an overlap"},
    {"epa_loop_area", [](auto& scene, auto&) -> Result<double> { return Cycle(scene).lost(); },
     "work lost in its cycle: loading, unloading, adhesion branch"},
    {"epa_rebound_speed", epa_rebound_speed, "sqrt(v^2 - 2 W/m*), W the area of that cycle"},
};

}  // namespace

std::span<const Formula> yielding_formulas() {
  return kYielding;
}

}  // namespace pastefit
