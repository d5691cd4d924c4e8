#include "calibrate/verify/case.h"

#include <algorithm>
#include <array>
#include <set>
#include <system_error>

#include "calibrate/base/data_folders.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/study/impact_json.h"

namespace pastefit {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::array<Named<Transform>, 5> kTransforms{{{"shift", Transform::shift},
                                                       {"turn", Transform::turn},
                                                       {"mirror", Transform::mirror},
                                                       {"boost", Transform::boost},
                                                       {"lengthen", Transform::lengthen}}};
constexpr std::array<Named<int>, 3> kAxes{{{"x", 0}, {"y", 1}, {"z", 2}}};
constexpr std::size_t kMostPoints = 100'000;

void read_formula(ObjectReader& reader, ByFormula& by) {
  std::string name;
  if (reader.text("formula", name, Need::required)) {
    std::set<std::string, std::less<>> names;
    for (const Formula& formula : formulas()) {
      names.emplace(formula.name);
      if (formula.name == name) by.formula = &formula;
    }
    if (!by.formula) {
      const auto near = nearest(name, names);
      reader.fault("formula", "there is no formula " + in_quotes(name),
                   near ? "did you mean " + in_quotes(*near) + "?" : "see pastefit verify --formulas");
    }
  }
  int grain = 0, axis = 0;
  if (reader.integer("grain", grain, 0, 1, Need::optional)) by.arguments.grain = static_cast<std::size_t>(grain);
  if (reader.choice("axis", axis, kAxes, Need::optional))
    by.arguments.axis = kAxes[static_cast<std::size_t>(axis)].name;
  reader.number("gap_m", by.arguments.gap_m, {-1e3, 1e3}, Need::optional);
}

void read_expected(ObjectReader& reader, const json& object, Check& check) {
  const auto given = object.find("expected");
  double value = 0;
  if (object.contains("at_most")) {
    reader.refuse("expected", "stands beside a bound", "give \"expected\" or \"at_most\"");
    if (reader.number("at_most", value, {}, Need::required)) check.expected = AtMost{value};
  } else if (given != object.end() && given->is_object()) {
    ByFormula by;
    reader.object("expected", Need::required, [&](ObjectReader& inner) { read_formula(inner, by); });
    if (by.formula) check.expected = by;
  } else if (reader.number("expected", value, {}, Need::required)) {
    check.expected = value;
  }
}

void read_check(ObjectReader& reader, const json& object, Check& check) {
  reader.text("known_deviation", check.known_deviation, Need::optional);
  if (object.contains("unchanged_under")) {
    Transform transform{};
    if (reader.choice("unchanged_under", transform, kTransforms, Need::required)) check.unchanged_under = transform;
    check.absolute = true;
    reader.number("absolute_tolerance", check.tolerance, {0, 1}, Need::required);
    return;
  }
  reader.text("reading", check.reading, Need::required);
  read_expected(reader, object, check);
  if (object.contains("at_most")) return;
  check.absolute = object.contains("absolute_tolerance");
  reader.number("absolute_tolerance", check.tolerance, {0, 1e12}, Need::optional);
  if (check.absolute)
    reader.refuse("tolerance", "stands beside an absolute one", "give one of them");
  else
    reader.number("tolerance", check.tolerance, {0, 1}, Need::required);
}

void read_point(ObjectReader& reader, const json& object, Point& point) {
  reader.text("label", point.label, Need::required);
  reader.object("set", Need::optional, [&](ObjectReader& inner) {
    for (const auto& [path, value] : object.at("set").items()) {
      inner.known(path);
      point.set.emplace_back(path, value);
    }
  });
  reader.object("published", Need::optional, [&](ObjectReader& inner) {
    for (const auto& [reading, value] : object.at("published").items())
      inner.number(reading, point.published[reading], {}, Need::required);
  });
}

template <class Body>
void for_each_object(ObjectReader& reader, const json& document, const std::string& key, Body body) {
  reader.known(key);
  const auto list = document.find(key);
  if (list == document.end()) return;
  if (!list->is_array() || list->empty()) {
    reader.fault(key, "is " + text_of(*list), "a list of objects with at least one");
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string place = key + "[" + std::to_string(i) + "]";
    if (!(*list)[i].is_object()) {
      reader.faults().push_back({place, "is " + text_of((*list)[i]), "an object { ... }"});
      continue;
    }
    ObjectReader inner((*list)[i], place, reader.faults());
    body(inner, (*list)[i]);
  }
}

/// Every combination of the grid's values with every point so far.
void read_grid(ObjectReader& reader, const json& document, std::vector<Point>& points) {
  reader.known("grid");
  const auto grid = document.find("grid");
  if (grid == document.end()) return;
  if (!grid->is_object()) return reader.fault("grid", "is " + text_of(*grid), "an object of paths and lists of values");
  for (const auto& [path, values] : grid->items()) {
    if (!values.is_array() || values.empty() || points.size() * values.size() > kMostPoints) {
      reader.fault("grid", printable(path) + " is " + text_of(values),
                   "a list of values, at most " + std::to_string(kMostPoints) + " points in all");
      return;
    }
    std::vector<Point> finer;
    for (const Point& point : points)
      for (const json& value : values) {
        Point next = point;
        const auto dot = path.rfind('.');
        next.label +=
            (next.label.empty() ? "" : ", ") + path.substr(dot == std::string::npos ? 0 : dot + 1) + " " + value.dump();
        next.set.emplace_back(path, value);
        finer.push_back(std::move(next));
      }
    points = std::move(finer);
  }
}

Case case_from_json(const json& document, Faults& faults) {
  Case test;
  ObjectReader reader(document, "", faults);
  reader.known("format");
  reader.text("title", test.title, Need::required);
  reader.text("source", test.source, Need::required);
  reader.known("scene");
  if (document.contains("scene") && document["scene"].is_object())
    test.scene = document["scene"];
  else
    reader.fault("scene", "is missing", "an impact: contact, density_kg_m3, grains, walls, duration_s ...");
  for_each_object(reader, document, "points", [&](ObjectReader& inner, const json& object) {
    read_point(inner, object, test.points.emplace_back());
  });
  if (test.points.empty()) test.points.emplace_back();
  read_grid(reader, document, test.points);
  for_each_object(reader, document, "checks", [&](ObjectReader& inner, const json& object) {
    read_check(inner, object, test.checks.emplace_back());
  });
  if (test.checks.empty()) reader.fault("checks", "claims nothing", "at least one check");
  return test;
}

}  // namespace

Result<Case> read_case(const fs::path& file) {
  Faults faults;
  const auto document = read_json(file, faults);
  if (!document) return faults;
  Faults inside;
  if (has_format(*document, "pastefit-case-1", inside)) {
    Case test = case_from_json(*document, inside);
    test.name = file.stem().string();
    if (inside.empty() && faults.empty()) return test;
  }
  for (Fault& fault : in_file(std::move(inside), file)) faults.push_back(std::move(fault));
  return faults;
}

std::vector<fs::path> shipped_cases() {
  std::vector<fs::path> folders;
  for (const fs::path& data : data_folders()) {
    folders.push_back(data / "cases");
    folders.push_back(data / ".." / "tests" / "cases");  // of the sources
  }
  for (const fs::path& folder : folders) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".json") files.push_back(entry.path().lexically_normal());
    std::ranges::sort(files);
    if (!files.empty()) return files;
  }
  return {};
}

Result<Impact> scene_at(const Case& test, const Point& point) {
  json scene = test.scene;
  Faults faults;
  for (const auto& [path, value] : point.set) {
    std::string pointer = "/" + path;
    std::ranges::replace(pointer, '.', '/');
    try {
      scene[json::json_pointer(pointer)] = value;
    } catch (const json::exception&) {
      faults.push_back({"scene", in_quotes(path) + " leads nowhere", "a path in the scene, e.g. grains.0.radius_m"});
    }
  }
  Impact impact;
  {
    ObjectReader reader(scene, point.label.empty() ? "scene" : "scene at \"" + point.label + "\"", faults);
    read_impact(reader, scene, impact);
  }
  if (!faults.empty()) return faults;
  return impact;
}

}  // namespace pastefit
