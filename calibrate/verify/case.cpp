#include "calibrate/verify/case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <system_error>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/machine.h"
#include "calibrate/study/impact_json.h"

namespace pastefit {

namespace {

const Vec3 kShift{0.37, -0.21, 0.53};  // [m]
const Vec3 kBoost{0.3, -0.7, 0.45};    // [m/s]
constexpr double kTurn = 0.7;          // [rad]
constexpr double kLonger = 3;

Vec3 turn(const Vec3& v) {
  const double c = std::cos(kTurn), s = std::sin(kTurn);
  return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

/// Transforms a direction, without position.
Vec3 arrow(const Vec3& v, Transform transform) {
  if (transform == Transform::turn) return turn(v);
  if (transform == Transform::mirror) return {v.x, -v.y, v.z};
  return v;
}

Vec3 place(const Vec3& v, Transform transform) {
  if (transform == Transform::shift) return v + kShift;
  if (transform == Transform::lengthen) return kLonger * v;
  return arrow(v, transform);
}

Vec3 velocity(const Vec3& v, Transform transform) {
  return transform == Transform::boost ? v + kBoost : arrow(v, transform);
}

/// Transforms a spin, a pseudovector: the mirror inverts its components in the mirror plane.
Vec3 spin(const Vec3& w, Transform transform) {
  if (transform == Transform::mirror) return {-w.x, w.y, -w.z};
  if (transform == Transform::lengthen) return (1 / kLonger) * w;
  return arrow(w, transform);
}

Shape shape_of(const Shape& shape, Transform transform) {
  const double longer = transform == Transform::lengthen ? kLonger : 1;
  if (const auto* plane = std::get_if<Plane>(&shape))
    return Plane{place(plane->point, transform), arrow(plane->normal, transform)};
  if (const auto* plate = std::get_if<Plate>(&shape))
    return Plate{place(plate->centre, transform), arrow(plate->along, transform), arrow(plate->across, transform),
                 longer * plate->half_length, longer * plate->half_width};
  const Shell& shell = std::get<Shell>(shape);
  return Shell{place(shell.base, transform), longer * shell.base_radius, longer * shell.top_radius,
               longer * shell.height};
}

void lengthen(Impact& test) {
  const double k = kLonger;
  test.contact = enlarged(test.contact, k);
  test.contact.bridge.viscosity_pa_s *= k;  // stress over rate: scales with time
  test.reference_radius_m *= k;
  test.gravity_m_s2 /= k;
  test.duration_s *= k;
  test.step_s *= k;
  for (ImpactGrain& grain : test.grains) {
    grain.radius_m *= k;
    if (grain.turns_at_s) *grain.turns_at_s *= k;
  }
  for (ImpactWall& wall : test.walls) {
    wall.turning_rad_s /= k;
    if (wall.rotor_mass_kg) *wall.rotor_mass_kg *= k * k * k;
  }
}

Vec3 reading(const Outcome& outcome, std::size_t grain, const std::string& what, const std::string& unit) {
  const auto component = [&](const char* axis) {
    return outcome.readings.find("grain" + std::to_string(grain) + "." + what + "_" + axis + "_" + unit).value_or(0);
  };
  return {component("x"), component("y"), component("z")};
}

}  // namespace

std::string_view claim_of(Transform transform) {
  constexpr std::array<std::string_view, 5> words{"ends alike when shifted", "ends alike when turned",
                                                  "ends alike in the mirror", "ends alike when boosted",
                                                  "ends alike when 3 x as large"};
  return words[static_cast<std::size_t>(transform)];
}

Impact transformed(const Impact& test, Transform transform) {
  Impact seen = test;
  for (ImpactGrain& grain : seen.grains) {
    grain.centre_m = place(grain.centre_m, transform);
    grain.velocity_m_s = velocity(grain.velocity_m_s, transform);
    grain.spin_rad_s = spin(grain.spin_rad_s, transform);
  }
  for (ImpactWall& wall : seen.walls) {
    wall.shape = shape_of(wall.shape, transform);
    wall.velocity_m_s = velocity(wall.velocity_m_s, transform);
    wall.hinge_m = place(wall.hinge_m, transform);
  }
  if (transform == Transform::lengthen) lengthen(seen);
  return seen;
}

double difference(const Impact& test, const Outcome& before, Transform transform, const Outcome& after) {
  double largest = 0, off = 0;
  for (std::size_t i = 0; i < test.grains.size(); ++i) {
    const double radius = test.grains[i].radius_m;
    const Vec3 v = reading(before, i, "velocity", "m_s"), w = reading(before, i, "spin", "rad_s");
    const Vec3 v_after = reading(after, i, "velocity", "m_s"), w_after = reading(after, i, "spin", "rad_s");
    largest = std::max({largest, norm(v), radius * norm(w)});
    off = std::max({off, norm(v_after - velocity(v, transform)), radius * norm(w_after - spin(w, transform))});
  }
  return largest > 0 ? off / largest : off;
}

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::array<Named<Transform>, 5> kTransforms{{{"shift", Transform::shift},
                                                       {"turn", Transform::turn},
                                                       {"mirror", Transform::mirror},
                                                       {"boost", Transform::boost},
                                                       {"lengthen", Transform::lengthen}}};
constexpr std::array<Named<double Vec3::*>, 3> kAxes{{{"x", &Vec3::x}, {"y", &Vec3::y}, {"z", &Vec3::z}}};
constexpr std::size_t kMostPoints = 100'000;

void read_formula(ObjectReader& reader, Check& check) {
  std::string name;
  if (reader.text("formula", name, Need::required)) {
    for (const Formula& formula : formulas())
      if (formula.name == name) check.formula = &formula;
    if (!check.formula)
      reader.fault("formula", "there is no formula " + in_quotes(name),
                   did_you_mean(name, names_of(formulas(), &Formula::name), "see pastefit verify --formulas"));
  }
  int grain = 0;
  if (reader.integer("grain", grain, 0, 1, Need::optional)) check.arguments.grain = static_cast<std::size_t>(grain);
  reader.choice("axis", check.arguments.axis, kAxes, Need::optional);
  reader.number("gap_m", check.arguments.gap_m, {-1e3, 1e3}, Need::optional);
}

void read_expected(ObjectReader& reader, Check& check) {
  const json* given = reader.content("expected");
  check.at_most = reader.has("at_most");
  if (check.at_most) {
    reader.refuse("expected", "stands beside a bound", "give \"expected\" or \"at_most\"");
    reader.number("at_most", check.expected, {}, Need::required);
  } else if (given && given->is_object()) {
    reader.object("expected", Need::required, [&](ObjectReader& inner) { read_formula(inner, check); });
  } else {
    reader.number("expected", check.expected, {}, Need::required);
  }
}

void read_check(ObjectReader& reader, Check& check) {
  reader.text("known_deviation", check.known_deviation, Need::optional);
  if (reader.has("unchanged_under")) {
    Transform transform{};
    if (reader.choice("unchanged_under", transform, kTransforms, Need::required)) check.unchanged_under = transform;
    check.absolute = true;
    reader.number("absolute_tolerance", check.tolerance, {0, 1}, Need::required);
    return;
  }
  reader.text("reading", check.reading, Need::required);
  read_expected(reader, check);
  if (check.at_most) return;
  check.absolute = reader.has("absolute_tolerance");
  reader.number("absolute_tolerance", check.tolerance, {0, 1e12}, Need::optional);
  if (check.absolute)
    reader.refuse("tolerance", "stands beside an absolute one", "give one of them");
  else
    reader.number("tolerance", check.tolerance, {0, 1}, Need::required);
}

void read_point(ObjectReader& reader, Point& point) {
  reader.text("label", point.label, Need::required);
  reader.object("set", Need::optional, [&](ObjectReader& inner) {
    for (const std::string& path : inner.keys()) {
      inner.known(path);
      point.set.emplace_back(path, *inner.content(path));
    }
  });
  reader.object("published", Need::optional, [&](ObjectReader& inner) {
    for (const std::string& reading : inner.keys()) inner.number(reading, point.published[reading], {}, Need::required);
  });
}

/// Combines every value of the grid with every point so far.
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

Result<Case> case_from_json(const json& document) {
  Case test;
  const Faults faults = read_document(document, "pastefit-case-1", [&](ObjectReader& reader) {
    reader.text("title", test.title, Need::required);
    reader.text("source", test.source, Need::required);
    reader.known("scene");
    if (document.contains("scene") && document["scene"].is_object())
      test.scene = document["scene"];
    else
      reader.fault("scene", "is missing", "an impact: contact, density_kg_m3, grains, walls, duration_s ...");
    reader.list("points", test.points, Need::optional, read_point);
    if (test.points.empty()) test.points.emplace_back();
    read_grid(reader, document, test.points);
    reader.list("checks", test.checks, Need::required, read_check);
  });
  if (!faults.empty()) return faults;
  return test;
}

}  // namespace

Result<Case> read_case(const fs::path& file) {
  return read_file(file, [&](const json& document) {
    Result<Case> test = case_from_json(document);
    if (test.ok()) test.value().name = file.stem().string();
    return test;
  });
}

std::vector<fs::path> shipped_cases() {
  std::vector<fs::path> folders;
  for (const fs::path& data : data_folders()) {
    folders.push_back(data / "cases");
    folders.push_back(data / ".." / "tests" / "cases");  // in the source tree
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
    read_impact(reader, impact);
  }
  if (!faults.empty()) return faults;
  return impact;
}

}  // namespace pastefit
