#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// The parameters a study may free or fix: scale-free, and admissible everywhere in their range. R is the mean grain
/// radius, c the attraction at touch, d_c the overlap at rupture, gamma the surface energy.
///
/// Each law of core/laws names those it is made of and makes its numbers in SI from them; a study has those of the laws
/// it chose, and those that no law names, which every test has. Of the present laws:
///
///   every attraction   strength_pa c/R^2 [Pa], rupture_gap_ratio -d_c/R, cohesion_ratio F_coh/c,
///                      viscosity_pa_s
///   with film formation besides, formation_ratio 2 offset/-d_c
///   polynomial         besides, rupture_force_ratio F(d_c)/c and curvature (core/laws/attraction.h)
///   jkr, dmt           adhesion_pa gamma/R [Pa]
///   sjkr               cohesion_energy_density_pa k [Pa]
///   epa, luding        plasticity_ratio 1 - k_1/k_2, adhesion_ratio k_c/k_1, pull_off_pa f0/R^2 [Pa]
///   rolling            rolling_friction, mould_rolling_friction, table_rolling_friction
///   whatever attracts  table_cohesion_factor, mould_cohesion_factor
///   every test         friction, restitution, youngs_modulus_pa, poissons_ratio, mould_friction, table_friction
struct ParameterKind {
  std::string_view name;
  double smallest, largest;  ///< admissible range
  double default_value;      ///< value when the study does not name it
  Scale scale;               ///< natural spacing
  std::string_view meaning;  ///< one line for help and reports
};

/// Between which values a fitted parameter is what its name says, and what it stands for beyond them.
struct PlausibleRange {
  std::string_view name;
  double smallest, largest;
  std::string_view below, above;  ///< the end of a sentence about such a value; empty if the range ends there
};

/// Of the parameters of which it is known. Sliding friction: dry mineral grains have 0.4 to 0.8, wetted and coated
/// ones less. Rolling friction is the tangent of the steepest slope on which a round grain stays (Ai, Chen, Rotter and
/// Ooi, Powder Technol. 206 (2011) 269): 0.5 is 27 degrees.
std::span<const PlausibleRange> plausible_ranges();

/// Every known parameter, in their fixed order.
std::span<const ParameterKind> parameter_kinds();

/// Whether the laws of this contact have the parameter. The others keep their default value, which acts on nothing.
bool has_parameter(const ContactModel& laws, std::string_view name);

/// Whether the parameter acts in the test: false of one of a surface that its apparatus has not, as a shear cell has no
/// table.
bool acts_in(const Test& test, std::string_view name);

/// What to say where a parameter of a surface is given that no test has. Requirement: `acts_in` is false of them.
Fault surface_of_no_test(std::string place, std::string_view name);

/// What to say where a parameter is given that no law of the contact has. Requirement: `has_parameter` is false.
Fault foreign_parameter(const ContactModel& laws, std::string place, std::string_view name);

/// Number of free parameters of a study.
int free_count(const Study& study);

/// Value of a free parameter at a coordinate 0 .. 1 between its bounds, evenly spread on its scale.
double value_between(const Parameter& parameter, double unit);

/// Its inverse up to rounding: the coordinate of a value; beyond 0 .. 1 for a value beyond the bounds.
double unit_of(const Parameter& parameter, double value);

/// The prior as a normal distribution of the coordinate: mean and standard deviation.
/// Requirement: the parameter has one.
struct UnitPrior {
  double mean = 0.5, deviation = 1;
};
UnitPrior unit_prior(const Parameter& parameter);

/// Values of all parameters at a point of the unit cube over the free ones. Shapes: free_count -> parameters.size().
std::vector<double> values_at(const Study& study, std::span<const double> unit_point);

/// The default value of every parameter, in their fixed order.
std::vector<double> default_values();

/// The test with these parameter values in the contact laws that it names (normal, attraction and its formation,
/// rolling): their numbers in SI, with R the mean radius of its grains, and each surface's own. Shape: one value for
/// each of `parameter_kinds()`.
Test with_contact_of(Test test, std::span<const double> values);

/// The test with the laws of a study that chooses none, Hertz and a polynomial bridge, and default values of their
/// parameters. Formation, rolling and the basis of friction stay.
Test with_default_contact(Test test);

/// The test with these parameter values, and this packing.
Test test_with(Test test, std::span<const double> values, std::uint64_t packing_seed);

/// The words of a parameter's spacing.
inline constexpr std::array<Named<Scale>, 2> scales{{{"linear", Scale::linear}, {"log", Scale::logarithmic}}};

}  // namespace pastefit
