#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// A parameter that a study may free or fix: scale-free, and admissible everywhere in its range. R: mean grain radius,
/// c: attraction at touch, d_c: overlap at rupture, gamma: surface energy.
///
/// Each law of core/laws lists its parameters and computes its SI constants from them. A study has the parameters of
/// the laws it chooses and those common to all tests:
///
///   every attraction   strength_pa c/R^2 [Pa], rupture_gap_ratio -d_c/R, cohesion_ratio F_coh/c,
///                      viscosity_pa_s
///   film formation     also formation_ratio 2 offset/-d_c
///   polynomial         also rupture_force_ratio F(d_c)/c and curvature (core/laws/attraction.h)
///   jkr, dmt           adhesion_pa gamma/R [Pa]
///   sjkr               cohesion_energy_density_pa k [Pa]
///   epa, luding        plasticity_ratio 1 - k_1/k_2, adhesion_ratio k_c/k_1, pull_off_pa f0/R^2 [Pa]
///   rolling            rolling_friction, mould_rolling_friction, table_rolling_friction
///   with attraction    table_cohesion_factor, mould_cohesion_factor
///   every test         friction, restitution, youngs_modulus_pa, poissons_ratio, mould_friction, table_friction
struct ParameterKind {
  std::string_view name;
  double smallest, largest;  ///< admissible range
  double default_value;      ///< value if the study does not name it
  Scale scale;               ///< natural spacing
  std::string_view meaning;  ///< one line for help and reports
};

/// Range in which a fitted parameter has its physical meaning, and the meaning of values beyond it.
struct PlausibleRange {
  std::string_view name;
  double smallest, largest;
  std::string_view below, above;  ///< end of a sentence on such a value; empty if the range ends there
};

/// Plausible ranges of some parameters. Sliding friction: 0.4 to 0.8 for dry mineral grains, less for wetted and coated
/// ones. Rolling friction: tangent of the steepest slope on which a round grain stays (Ai, Chen, Rotter and Ooi, Powder
/// Technol. 206 (2011) 269); 0.5 is 27 degrees.
std::span<const PlausibleRange> plausible_ranges();

/// Every known parameter, in fixed order.
std::span<const ParameterKind> parameter_kinds();

/// True if the laws of this contact use the parameter. Unused parameters keep their default value, which has no effect.
bool has_parameter(const ContactModel& laws, std::string_view name);

/// True if the parameter acts in the test; false for surfaces that its apparatus lacks, e.g. the table of a shear cell.
bool acts_in(const Test& test, std::string_view name);

/// Fault of a given parameter of a surface that no test has. Requirement: `acts_in` is false for every test.
Fault surface_of_no_test(std::string place, std::string_view name);

/// Fault of a name that no parameter has.
Fault no_such_parameter(std::string where, std::string_view name);

/// Fault of a given parameter that no law of the contact uses. Requirement: `has_parameter` is false.
Fault foreign_parameter(const ContactModel& laws, std::string place, std::string_view name);

int free_count(const Study& study);

/// Value of a free parameter at a coordinate in [0, 1] between its bounds, on its scale.
double value_between(const Parameter& parameter, double unit);

/// Inverse of `value_between` up to rounding; outside [0, 1] for values beyond the bounds.
double unit_of(const Parameter& parameter, double value);

/// Prior as a normal distribution of the coordinate. Requirement: the parameter has a prior.
struct UnitPrior {
  double mean = 0.5, deviation = 1;
};
UnitPrior unit_prior(const Parameter& parameter);

/// Values of all parameters at a point of the unit cube of the free ones. Shapes: free_count -> parameters.size().
std::vector<double> values_at(const Study& study, std::span<const double> unit_point);

/// Default value of every parameter, in fixed order.
std::vector<double> default_values();

/// The test with these parameter values converted to the SI constants of its contact laws (normal, attraction and its
/// formation, rolling) and of each surface; R is the mean radius of its grains. Shape: one value for each of
/// `parameter_kinds()`.
Test with_contact_of(Test test, std::span<const double> values);

/// The test with the default laws, Hertz and a polynomial bridge, and default parameters. Formation, rolling and
/// friction basis are unchanged.
Test with_default_contact(Test test);

Test test_with(Test test, std::span<const double> values, std::uint64_t packing_seed);

inline constexpr std::array<Named<Scale>, 2> scales{{{"linear", Scale::linear}, {"log", Scale::logarithmic}}};

/// {"name", "free"}, with {"lower", "upper", "scale"} of a free parameter or {"value"} of a fixed one, and its "prior".
inline nlohmann::ordered_json parameter_json(const Parameter& parameter) {
  nlohmann::ordered_json out{{"name", parameter.name}, {"free", parameter.free}};
  if (parameter.free) {
    out["lower"] = parameter.lower;
    out["upper"] = parameter.upper;
    out["scale"] = word_of(parameter.scale, scales);
  } else {
    out["value"] = parameter.value;
  }
  if (parameter.prior)
    out["prior"] = {{"value", parameter.prior->value}, {"standard_deviation", parameter.prior->standard_deviation}};
  return out;
}

}  // namespace pastefit
