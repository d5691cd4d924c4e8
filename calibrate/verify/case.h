#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "calibrate/verify/formulas.h"
#include "core/apparatus/impact/impact.h"

namespace pastefit {

/// Ways to look at the same experiment that change nothing but what they must.
enum class Transform {
  shift,     ///< everything elsewhere
  turn,      ///< about the vertical
  mirror,    ///< y against -y
  boost,     ///< seen from a frame in constant motion; for scenes without weight and held grains
  lengthen,  ///< all lengths three times as long, at equal speeds and stresses: times grow alike, bridges by their
             ///< scaling
};

/// What a check of it says: "ends alike in the mirror".
std::string_view claim_of(Transform transform);

/// The experiment as it is seen after the transformation.
Impact transformed(const Impact& test, Transform transform);

/// By how much the ends of both experiments differ beyond the transformation: the largest difference of a velocity (a
/// spin times its radius counts as one), over the largest velocity.
double difference(const Impact& test, const Outcome& before, Transform transform, const Outcome& after);

/// What a reading is held against.
struct AtMost {
  double bound = 0;
};
struct ByFormula {
  const Formula* formula = nullptr;
  FormulaArguments arguments;
};
using Expected = std::variant<double, AtMost, ByFormula>;

/// One claim of a case.
struct Check {
  std::string reading;                       ///< a reading of the impact apparatus; empty with `unchanged_under`
  std::optional<Transform> unchanged_under;  ///< the same experiment seen from elsewhere ends the same
  Expected expected = 0.0;
  double tolerance = 0;
  bool absolute = false;        ///< in the unit of the reading; otherwise relative to what is expected
  std::string known_deviation;  ///< why the engine fails this check, if it is known to; empty: it has to pass
};

/// One setting of a case: what differs from its scene, and figures that a publication prints for it.
struct Point {
  std::string label;
  std::vector<std::pair<std::string, nlohmann::json>> set;  ///< path in the scene, e.g. "grains.0.radius_m"
  std::map<std::string, double> published;                  ///< by reading; the closed form must agree to 3 digits
};

/// A physics case: a scene, its variations, and what has to come out of each.
struct Case {
  std::string name;  ///< of the file, without its ending
  std::string title;
  std::string source;
  nlohmann::json scene;
  std::vector<Point> points;  ///< at least one
  std::vector<Check> checks;
};

/// Reads a case file ("format": "pastefit-case-1"; schema: data/schema/case.schema.json).
/// Errors: every fault with its place; scenes are read when the case is run.
Result<Case> read_case(const std::filesystem::path& file);

/// The files of the shipped cases in the order of their names: those in `cases` of the first folder of data
/// (`data_folders`) that has some.
std::vector<std::filesystem::path> shipped_cases();

/// The scene of one point of a case.
Result<Impact> scene_at(const Case& test, const Point& point);

}  // namespace pastefit
