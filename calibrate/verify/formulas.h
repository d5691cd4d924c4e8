#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/apparatus/impact/approach.h"
#include "core/result.h"

namespace pastefit {

/// What a closed form may be asked for besides the scene.
struct FormulaArguments {
  std::size_t grain = 0;
  std::string axis = "x";  ///< "x", "y" or "z"
  double gap_m = 0;
};

/// What a closed form reads off the scene besides its first grain. "The pair" is the first grain with its partner: the
/// second grain, or else the first wall. A rotor is a plate, the first wall, that turns freely about a hinge.
enum class FormulaNeeds { grain, pair, wall, rotor };

/// The pair of a scene that has one.
Approach pair_of(const Impact& scene);

/// A closed form of a few-body test; all it needs is the scene.
struct Formula {
  std::string_view name;
  Result<double> (*value)(const Impact& scene, const FormulaArguments& arguments);
  std::string_view meaning;  ///< one line with the formula and its limits
  FormulaNeeds needs = FormulaNeeds::pair;
};

/// The value of a closed form. Errors: the scene lacks what the formula needs, or is outside of its validity.
Result<double> value_of(const Formula& formula, const Impact& scene, const FormulaArguments& arguments);

/// Every closed form that a case may name.
std::span<const Formula> formulas();

}  // namespace pastefit
