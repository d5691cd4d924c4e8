#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/study/lab.h"
#include "tests/calibrate/files.h"

namespace pastefit {
namespace {

using nlohmann::json;

json shear_lab() {
  return json::parse(template_text("shear-lab").value(), nullptr, true, true);
}

Faults faults_of_shear(const json& lab) {
  const Result<Lab> read = lab_from_json(lab, ".");
  return read.ok() ? Faults{} : read.faults();
}

TEST_CASE("a shear cell is read in millimetres, and survives JSON bit for bit") {
  json document = shear_lab();
  document["apparatus"]["pour_speed_mm_s"] = 300;
  document["apparatus"]["lid_speed_mm_s"] = 50;
  document["apparatus"]["tools"] = {{"friction", 0.1}, {"cohesion_factor", 0.5}};
  const Result<Lab> lab = lab_from_json(document, ".");
  INFO((lab.ok() ? "" : message_of(lab.faults())));
  REQUIRE(lab.ok());
  const auto& test = std::get<ShearCell>(lab.value().test);
  CHECK(test.length_m == 0.018);
  CHECK(test.width_m == 0.023);
  CHECK(test.fill_height_m == 0.016);
  CHECK(test.lid_ribs.height_m == 0.003);
  CHECK(test.lid_ribs.thickness_m == Approx(0.0008));
  CHECK(test.base_ribs.pitch_m == Approx(0.00535));
  CHECK(test.normal_stress_pa == 2000);
  CHECK(test.shear_speed_m_s == Approx(3.813e-5));
  CHECK(test.final_displacement_m == Approx(0.0114));
  CHECK(test.pour_speed_m_s == 0.3);
  CHECK(test.lid_speed_m_s == 0.05);
  CHECK(test.tools.friction == 0.1);
  CHECK(test.tools.youngs_modulus_pa == ShearCell{}.tools.youngs_modulus_pa);
  const std::string text = to_json(lab.value().test).dump();
  const Result<Test> back = test_from_json(json::parse(text));
  REQUIRE(back.ok());
  CHECK(to_json(back.value()).dump() == text);
}

TEST_CASE("faults of a shear cell are named in the words of its file, all in one message") {
  json lab = shear_lab();
  lab["apparatus"]["length_mm"] = 9;
  CHECK(test::says(test::at(faults_of_shear(lab), "grains.radius_mm"), "few granules"));
  lab = shear_lab();
  lab["apparatus"]["normal_stress_pa"] = -2000;
  lab["apparatus"]["lid_ribs"]["height_mm"] = -1;
  CHECK(test::says(test::at(faults_of_shear(lab), "apparatus.normal_stress_pa"), "is -2000"));
  CHECK(test::says(test::at(faults_of_shear(lab), "apparatus.lid_ribs.height_mm"), "is -1"));
  lab = shear_lab();
  lab["apparatus"]["base_ribs"]["pitch_mm"] = 2.9;
  lab["apparatus"]["lid_speed_mm_s"] = 9000;
  CHECK(test::says(test::at(faults_of_shear(lab), "apparatus.base_ribs.pitch_mm"), "less than a granule"));
  CHECK(test::says(test::at(faults_of_shear(lab), "apparatus.lid_speed_mm_s"), "sound in a bed"));
  lab = shear_lab();
  lab["apparatus"].erase("lid_ribs");
  CHECK_FALSE(test::at(faults_of_shear(lab), "apparatus.lid_ribs").what.empty());
}

TEST_CASE("beds whose stress is not steady are told of") {
  Readings steady, changing;
  steady.set("shear.steady_from_mm", 1);
  changing.set("shear.steady_from_mm", 7);
  const ShearCell test;
  CHECK(remarks_on(test, std::vector{steady}).empty());
  CHECK_THAT(remarks_on(test, std::vector{steady, changing}), Catch::Contains("1 of 2 beds"));
}

}  // namespace
}  // namespace pastefit
