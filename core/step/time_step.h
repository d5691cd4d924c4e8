#pragma once

#include "core/step/step_options.h"
#include "core/world/world.h"

namespace pastefit {

/// What limits the step of a scene.
struct StabilityLimits {
  double smallest_radius = 0;  ///< [m]
  double smallest_mass = 0;    ///< [kg]
  double fastest = 0;          ///< [m/s]
  double stiffest = 0;         ///< largest sum of the stiffnesses at a grain over its mass [1/s^2]
};

/// The largest step the scene allows now [s], the least of four:
///   stability of the leapfrog: safety * 2/omega, omega^2 <= max over grains of 2 sum(k)/m (Gershgorin; k the largest
///   stiffness of a contact, rotation counted);
///   impacts: the shortest collision (laws/normal.h) at the largest speed takes impact_resolution/(1 - e^2)^(1/3)
///   steps, at most 6.3 impact_resolution, so that the integration's error, which falls with the cube of their number,
///   stays the same small share of the energy that the collision loses;
///   bridges: none is crossed in fewer than bridge_resolution steps. A grain that is ten times as fast as a bridge can
///   make it feels a hundredth of its energy there; beyond that the step does not follow the speed any more;
///   viscous liquid: the dampers of a grain with eight neighbours at the roughness need not be weakened to be stable.
double advised_step(const World& world, const StabilityLimits& limits, const StepOptions& options);

/// Steps up to this keep the viscous dampers of a grain with eight neighbours at the roughness stable without weakening
/// them: dt (sum of c/m over both bodies of a pair) is at most 2 [s] (core/laws/lubrication.h). 1e300 without
/// viscosity.
double viscous_step(const PairConstants& pair, double radius, double mass);

/// The largest viscosity that grains of this size and mass can have [Pa s]: beyond it the step would be less than a
/// twentieth of what the springs of such grains allow at their resting overlap. It goes with R, and grows with the
/// modulus. Requirement: the model has a bridge.
double largest_viscosity(ContactModel model, double radius, double mass, const StepOptions& options = {});

/// The step a run takes: as advised, but constant for long. A step that follows the stiffness of a contact up and down
/// creates energy in every collision (14 % of what a slump puts in, in one case of the stress test). So it takes one of
/// sixteen values per octave, falls at once, and rises only to what two whole windows would have allowed.
class TimeStep {
 public:
  /// Takes the advice for the next step [s] and returns the step [s].
  double next(double advised);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(step_, lowest_, lowest_before_, in_window_, first_, smallest_);
  }
  /// Whether it can have come about by `next`.
  bool is_sound() const;
  double first() const { return first_; }
  double smallest() const { return smallest_; }  ///< of all the advice so far

 private:
  static constexpr int kWindow = 64;    // steps; a collision takes 10 to 63
  static constexpr double kRise = 1.2;  // largest rise between two windows

  double step_ = 0;
  double lowest_ = 1e300, lowest_before_ = 1e300;  ///< in this window and the last
  int in_window_ = 0;
  double first_ = 0, smallest_ = 1e300;
};

}  // namespace pastefit
