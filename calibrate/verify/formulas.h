#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/apparatus/impact/approach.h"
#include "core/result.h"

namespace pastefit {

/// Arguments of a closed form besides the scene.
struct FormulaArguments {
  std::size_t grain = 0;
  double Vec3::*axis = &Vec3::x;
  double gap_m = 0;
};

/// Required parts of a scene besides its first grain. The pair is the first grain with its partner: the second grain,
/// otherwise the first wall. A rotor is a plate, the first wall, that rotates freely about a hinge.
enum class FormulaNeeds { grain, pair, wall, rotor };

/// Pair of a scene. Requirement: it has one.
Approach pair_of(const Impact& scene);
/// Fraction of the grains' attraction that acts in the pair: for a wall, its own.
double share_of(const Impact& scene);
/// Relative speed of the pair after losing this work; 0 if the work exceeds its energy.
double speed_after(const Approach& pair, double work_j);
/// Integral of a smooth function.
double integral(const std::function<double(double)>& slope, double from, double to);
/// Fault of a scene outside the validity of a formula.
Fault outside(std::string what);

/// Closed form of a few-body test, a function of the scene.
struct Formula {
  std::string_view name;
  Result<double> (*value)(const Impact& scene, const FormulaArguments& arguments);
  std::string_view meaning;  ///< one line with formula and limits
  FormulaNeeds needs = FormulaNeeds::pair;
};

/// Evaluates a closed form. Errors: the scene lacks required parts, or is outside the validity.
Result<double> value_of(const Formula& formula, const Impact& scene, const FormulaArguments& arguments);

/// Every closed form that a case may name.
std::span<const Formula> formulas();

/// Those of adhesive contacts, with and without yielding, and of viscous bridges.
std::span<const Formula> sticking_formulas();
std::span<const Formula> viscous_formulas();

}  // namespace pastefit
