#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/verify/formulas.h"
#include "core/apparatus/impact/impact.h"

namespace pastefit {

/// Transformations of an experiment that must not change its result.
enum class Transform {
  shift,     ///< of all positions
  turn,      ///< about the vertical
  mirror,    ///< y against -y
  boost,     ///< to a frame in constant motion; for scenes without weight and held grains
  lengthen,  ///< all lengths times three at equal speeds and stresses: times grow alike, bridges by their scaling
};

/// Claim of a check: "ends alike in the mirror".
std::string_view claim_of(Transform transform);

/// The transformed experiment.
Impact transformed(const Impact& test, Transform transform);

/// Deviation of the end states after undoing the transformation: largest difference of a velocity (or spin times
/// radius), over the largest velocity.
double difference(const Impact& test, const Outcome& before, Transform transform, const Outcome& after);

/// One claim of a case.
struct Check {
  std::string reading;                       ///< of the impact apparatus; empty with `unchanged_under`
  std::optional<Transform> unchanged_under;  ///< the result is invariant under this transformation
  double expected = 0;                       ///< value of the reading, unless a formula gives it
  bool at_most = false;                      ///< `expected` is an upper bound
  const Formula* formula = nullptr;
  FormulaArguments arguments;  ///< of the formula
  double tolerance = 0;
  bool absolute = false;        ///< in the unit of the reading; otherwise relative to the expected value
  std::string known_deviation;  ///< reason for an accepted failure of the engine; empty: the check must pass
};

/// Setting of a case: differences from its scene, and published values.
struct Point {
  std::string label;
  std::vector<std::pair<std::string, nlohmann::json>> set;  ///< path in the scene, e.g. "grains.0.radius_m"
  std::map<std::string, double> published;                  ///< by reading; the formula must agree to 3 digits
};

/// Physics case: a scene, its variations, and the expected results.
struct Case {
  std::string name;  ///< file name without ending
  std::string title;
  std::string source;
  nlohmann::json scene;
  std::vector<Point> points;  ///< at least one
  std::vector<Check> checks;
};

/// Reads a case file ("format": "pastefit-case-1"; schema: data/schema/case.schema.json). Errors: every fault, with its
/// place. Scenes are read only when the case is run.
Result<Case> read_case(const std::filesystem::path& file);

/// Shipped cases in alphabetical order: the files in `cases` of the first data folder (`data_folders`) that has any.
std::vector<std::filesystem::path> shipped_cases();

Result<Impact> scene_at(const Case& test, const Point& point);

}  // namespace pastefit
