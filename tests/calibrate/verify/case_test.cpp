#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/verify/verify.h"
#include "tests/calibrate/folder.h"

namespace pastefit {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A head-on collision of two glass spheres, and one check of it.
json collision() {
  return json::parse(R"({
    "format": "pastefit-case-1", "title": "glass", "source": "Hertz",
    "scene": {
      "contact": {"youngs_modulus_pa": 4.8e10, "poissons_ratio": 0.2},
      "density_kg_m3": 2800,
      "grains": [{"radius_m": 0.01, "centre_m": [-0.01, 0, 0], "velocity_m_s": [10, 0, 0]},
                 {"radius_m": 0.01, "centre_m": [0.01, 0, 0], "velocity_m_s": [-10, 0, 0]}],
      "duration_contacts": 1.2},
    "checks": [{"reading": "max_force_n", "expected": {"formula": "hertz_max_force"}, "tolerance": 1e-3}]})");
}

Result<Case> read(const json& document) {
  const test::Folder folder;  // of its own: ctest runs cases side by side
  const fs::path file = folder.path() / "case.json";
  std::ofstream(file) << document;
  return read_case(file);
}

std::vector<CheckRow> rows_of(const json& document) {
  const auto test = read(document);
  INFO((test.ok() ? "" : message_of(test.faults())));
  REQUIRE(test.ok());
  auto rows = verify(test.value());
  INFO((rows.ok() ? "" : message_of(rows.faults())));
  REQUIRE(rows.ok());
  return std::move(rows).value();
}

std::string complaint_about(const json& document) {
  const auto test = read(document);
  if (!test.ok()) return message_of(test.faults());
  const auto rows = verify(test.value());
  return rows.ok() ? "" : message_of(rows.faults());
}

}  // namespace

TEST_CASE("a check passes at what theory says and fails one percent beside it") {
  json test = collision();
  CHECK(rows_of(test)[0].verdict == CaseVerdict::pass);
  test["checks"][0]["expected"] = 10696.9 * 1.01;
  const CheckRow row = rows_of(test)[0];
  CHECK(row.verdict == CaseVerdict::fail);
  CHECK(row.error == Approx(0.01 / 1.01).epsilon(0.02));
}

TEST_CASE("a known deviation is no failure, but is told apart from a pass") {
  json test = collision();
  test["checks"][0]["expected"] = 1;
  test["checks"][0]["known_deviation"] = "spoiled";
  const CheckRow row = rows_of(test)[0];
  CHECK(row.verdict == CaseVerdict::known);
  CHECK(row.note == "spoiled");
}

TEST_CASE("a reading beyond its bound fails") {
  json test = collision();
  test["checks"] = json::parse(R"([{"reading": "kinetic_energy_ratio", "at_most": 0.99}])");
  CHECK(rows_of(test)[0].verdict == CaseVerdict::fail);
  test["checks"][0]["at_most"] = 1.0001;
  CHECK(rows_of(test)[0].verdict == CaseVerdict::pass);
}

TEST_CASE("a reading that the test does not have fails its check") {
  json test = collision();
  test["checks"] = json::parse(R"([{"reading": "rotor_time_s", "expected": 1, "tolerance": 0.1}])");
  CHECK(rows_of(test)[0].verdict == CaseVerdict::fail);
}

TEST_CASE("grid and points are combined, and the worst point stands for a check") {
  json test = collision();
  test["points"] =
      json::parse(R"([{"label": "small", "set": {"grains.0.velocity_m_s": [9, 0, 0]}}, {"label": "as is"}])");
  test["grid"] = {{"density_kg_m3", {1000, 2000, 2800}}};
  test["checks"][0]["expected"] = 10696.9;
  const auto rows = rows_of(test);
  CHECK(rows.size() == 6);
  const auto worst = worst_rows(rows);
  REQUIRE(worst.size() == 1);
  CHECK(worst[0].point == "small, density_kg_m3 1000");
}

TEST_CASE("a published figure that the closed form does not give is a fault of the case") {
  json test = collision();
  test["points"] = json::parse(R"([{"label": "glass", "published": {"max_force_n": 10696.9}}])");
  CHECK(complaint_about(test).empty());
  test["points"][0]["published"]["max_force_n"] = 10796.9;
  CHECK_THAT(complaint_about(test), Catch::Contains("not what is published"));
}

TEST_CASE("a closed form outside of its validity is a fault of the case") {
  // A slow spin sticks before the collision is over.
  json test = json::parse(R"({
    "format": "pastefit-case-1", "title": "spin", "source": "Coulomb",
    "scene": {
      "contact": {"youngs_modulus_pa": 7e10, "poissons_ratio": 0.33}, "density_kg_m3": 2700,
      "grains": [{"radius_m": 0.1, "centre_m": [0, 0, 0.1], "velocity_m_s": [0, 0, -0.2], "spin_rad_s": [0, 1, 0]}],
      "walls": [{"plane": {}, "youngs_modulus_pa": 1e20, "friction": 0.4}], "duration_contacts": 2},
    "checks": [{"reading": "grain0.velocity_x_m_s", "expected": {"formula": "collision_velocity", "axis": "x"},
                "tolerance": 0.01}]})");
  CHECK_THAT(complaint_about(test), Catch::Contains("does not slide"));
}

TEST_CASE("every fault of a case file is named with its place") {
  json test = collision();
  test["checks"][0]["tolerence"] = 1e-3;
  test["checks"][0]["expected"]["formula"] = "hertz_maximal_force";
  test["sauce"] = "x";
  const std::string words = complaint_about(test);
  CHECK_THAT(words, Catch::Contains("checks[0].tolerence") && Catch::Contains("did you mean \"tolerance\"?"));
  CHECK_THAT(words, Catch::Contains("checks[0].expected.formula") && Catch::Contains("hertz_max_force"));
  CHECK_THAT(words, Catch::Contains("sauce"));

  test = collision();
  test["scene"]["grains"][1]["radius"] = 1;
  test["scene"]["grains"][0]["centre_m"] = {0, 0};
  const std::string scene = complaint_about(test);
  CHECK_THAT(scene, Catch::Contains("scene.grains[1].radius") && Catch::Contains("scene.grains[0].centre_m"));
}

TEST_CASE("a path that leads nowhere in the scene is a fault") {
  json test = collision();
  test["grid"] = {{"grains.x.radius_m", {0.1}}};
  CHECK_THAT(complaint_about(test), Catch::Contains("leads nowhere"));
}

TEST_CASE("a mirror image seen in the mirror is the original") {
  const auto test = read(collision());
  REQUIRE(test.ok());
  Impact scene = scene_at(test.value(), test.value().points[0]).value();
  scene.grains[0].spin_rad_s = {1, 2, 3};
  const Impact image = transformed(scene, Transform::mirror);
  CHECK(image.grains[0].spin_rad_s.x == -1);
  CHECK(image.grains[0].spin_rad_s.y == 2);
  CHECK(image.grains[0].spin_rad_s.z == -3);
  CHECK(transformed(image, Transform::mirror).grains[0].spin_rad_s.z == 3);
}

TEST_CASE("an experiment that is enlarged by the wrong rule does not end alike") {
  json test = collision();
  test["scene"]["contact"]["cohesion_n"] = 5000;
  test["checks"] = json::parse(R"([{"unchanged_under": "lengthen", "absolute_tolerance": 1e-6}])");
  CHECK(rows_of(test)[0].verdict == CaseVerdict::pass);
  const auto read_test = read(test);
  const Impact scene = scene_at(read_test.value(), {}).value();
  // Cohesion has to grow with the square of the length.
  Impact spoiled = transformed(scene, Transform::lengthen);
  spoiled.contact.cohesion_n = 5000;
  CHECK(difference(scene, simulate(scene), Transform::lengthen, simulate(spoiled)) > 1e-4);
}

TEST_CASE("the shipped cases are there, are read, and every claim names its source") {
  const auto files = shipped_cases();
  CHECK(files.size() >= 30);
  for (const fs::path& file : files) {
    const auto test = read_case(file);
    INFO((test.ok() ? file.string() : message_of(test.faults())));
    REQUIRE(test.ok());
    CHECK_FALSE(test.value().source.empty());
  }
}

}  // namespace pastefit
