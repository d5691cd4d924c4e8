#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/result.h"
#include "core/rigs/impact/impact.h"

namespace pastefit {

/// What a closed form may be asked for besides the scene.
struct FormulaArguments {
  std::size_t grain = 0;
  std::string axis = "x";  ///< "x", "y" or "z"
  double gap_m = 0;
};

/// A closed form of a few-body test; all it needs is the scene. Errors: the scene is outside of its validity.
///
/// "The pair" is the first grain with its partner: the second grain, or else the first wall.
struct Formula {
  std::string_view name;
  Result<double> (*value)(const Impact& scene, const FormulaArguments& arguments);
  std::string_view meaning;  ///< one line with the formula and its limits
};

/// Every closed form that a case may name.
std::span<const Formula> formulas();

}  // namespace pastefit
