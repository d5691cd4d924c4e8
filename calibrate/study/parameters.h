#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// The parameters a study may free or fix. The first five span the polynomial bridge in coordinates that are
/// scale-free and admissible everywhere in their range:
///
///   strength_pa           c / R^2, attraction at touch over the squared mean grain radius, > 0      [Pa]
///   rupture_force_ratio   f = F(d_c)/c, force left when the bridge ruptures, 0 .. 1
///   curvature             k, shape of the decay, -1 (flat at touch) .. 0 (straight) .. 1 (flat at rupture)
///   rupture_gap_ratio     g = -d_c/R, 0 < g <= 1
///   offset_ratio          offset/R, 0 .. 1
///
/// With s = d/d_c: F/c = 1 - (1 - f)[(1 + k) s - k s^2], hence
///   a = k (1 - f) c / d_c^2,   b = (1 - f)(1 + k) c / |d_c|.
/// Source of the law: Platzer & Fimbinger, BHM 167 (2022) 61-65; the coordinates are ours.
///
/// Others: friction, rolling_friction, restitution, youngs_modulus_pa, poissons_ratio, cohesion_ratio (F_coh/c),
/// mould_friction, table_friction, table_cohesion_factor, mould_cohesion_factor.
struct ParameterKind {
  std::string_view name;
  double smallest, largest;  ///< admissible range
  double usual;              ///< value when the study does not name it
  Scale scale;               ///< natural spacing
  std::string_view meaning;  ///< one line for help and reports
};

/// Every known parameter, in their fixed order.
std::span<const ParameterKind> parameter_kinds();

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
std::vector<double> values_at(const Study& study, const Eigen::VectorXd& unit_point);

/// The usual value of every parameter, in their fixed order.
std::vector<double> usual_values();

/// The test with these parameter values in its contact laws: a, b, c, d_c and offset in SI from the scale-free
/// coordinates, with R the mean radius of its grains, and each surface's own. Shape: one value for each of
/// `parameter_kinds()`.
/// In touch formation the offset only bounds the bridge: -d_c = R min(rupture_gap_ratio, 2 offset_ratio).
Test with_contact_of(Test test, std::span<const double> values);

/// The test with these parameter values, and this packing.
Test test_with(Test test, std::span<const double> values, std::uint64_t packing_seed);

/// The words of a parameter's spacing.
inline constexpr std::array<Named<Scale>, 2> scales{{{"linear", Scale::linear}, {"log", Scale::logarithmic}}};

}  // namespace pastefit
