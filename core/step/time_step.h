#pragma once

#include "core/step/step_options.h"
#include "core/world/world.h"

namespace pastefit {

/// Quantities that limit the time step.
struct StabilityLimits {
  double smallest_radius = 0;  ///< [m]
  double smallest_mass = 0;    ///< [kg]
  double fastest = 0;          ///< [m/s]
  double stiffest = 0;         ///< largest sum of contact stiffnesses of a grain over its mass [1/s^2]
};

/// The largest stable step of the scene now [s], the least of four limits:
///   stability    of the leapfrog: safety * 2/omega, omega^2 <= max over grains of 2 sum(k)/m (Gershgorin; k is the
///                largest stiffness of a contact, including rotation)
///   impacts      the shortest collision (laws/normal.h) at the largest speed takes impact_resolution/(1 - e^2)^(1/3)
///                steps, at most 6.3 impact_resolution. The integration error decreases with the cube of their number,
///                and so remains the same small share of the energy lost in the collision
///   bridges      none is crossed in fewer than bridge_resolution steps. A grain ten times as fast as a bridge can make
///                it gains a hundredth of its energy there, so the step does not follow higher speeds
///   viscosity    the dampers of a grain with eight neighbours at the roughness are stable at full strength
double advised_step(const World& world, const StabilityLimits& limits, const StepOptions& options);

/// Largest step [s] at which the viscous dampers of a grain with eight neighbours at the roughness are stable at full
/// strength: dt (sum of c/m over both bodies of a pair) <= 2 (core/laws/lubrication.h). 1e300 without viscosity.
double viscous_step(const PairConstants& pair, double radius, double mass);

/// The largest viscosity for grains of this size and mass [Pa s]: beyond it the step would be less than a twentieth of
/// what the springs of such grains allow at their resting overlap. Proportional to R, and grows with the modulus.
/// Requirement: the model has a bridge.
double largest_viscosity(ContactModel model, double radius, double mass, const StepOptions& options = {});

/// The step that a run takes: as computed, but constant for long. A step that follows the stiffness of a contact
/// creates energy in every collision (14 % of the energy put in by a slump, in one case of the stress test). The step
/// of a run therefore has one of sixteen values per octave, decreases at once, and increases only to what two whole
/// windows would have allowed.
class TimeStep {
 public:
  /// Takes the computed limit for the next step [s] and returns the step [s].
  double next(double advised);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(step_, lowest_, lowest_before_, in_window_, first_, smallest_);
  }
  /// True if `next` can have led to this state.
  bool is_sound() const;
  double first() const { return first_; }
  double smallest() const { return smallest_; }  ///< smallest limit so far

 private:
  static constexpr int kWindow = 64;    // steps; a collision takes 10 to 63
  static constexpr double kRise = 1.2;  // largest rise between two windows

  double step_ = 0;
  double lowest_ = 1e300, lowest_before_ = 1e300;  ///< in this window and the last
  int in_window_ = 0;
  double first_ = 0, smallest_ = 1e300;
};

}  // namespace pastefit
