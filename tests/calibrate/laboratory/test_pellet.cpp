#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/study/lab.h"
#include "calibrate/study/parameters.h"
#include "tests/calibrate/files.h"

namespace pastefit {
namespace {

using nlohmann::json;

json template_of_pellet_lab() {
  return json::parse(template_text("pellet-lab").value(), nullptr, true, true);
}

Faults faults_of_pellet_lab(const json& lab) {
  const Result<Lab> read = lab_from_json(lab, ".");
  return read.ok() ? Faults{} : read.faults();
}

TEST_CASE("a pellet crush is read in millimetres, and survives JSON bit for bit") {
  json document = template_of_pellet_lab();
  document["apparatus"]["pour_speed_mm_s"] = 300;
  document["apparatus"]["tools"] = {{"friction", 0.1}, {"cohesion_factor", 0.5}};
  const Result<Lab> lab = lab_from_json(document, ".");
  INFO((lab.ok() ? "" : message_of(lab.faults())));
  REQUIRE(lab.ok());
  const auto& test = std::get<PelletCrush>(lab.value().test);
  CHECK(test.die_diameter_m == 0.025);
  CHECK(test.fill_height_m == 0.029);
  CHECK(test.pressed_height_m == 0.022);
  CHECK(test.punch_speed_m_s == 0.0015);
  CHECK(test.platen_speed_m_s == 0.1);
  CHECK(test.pour_speed_m_s == 0.3);
  CHECK(test.tools.friction == 0.1);
  CHECK(test.tools.cohesion_factor == 0.5);
  CHECK(test.tools.youngs_modulus_pa == PelletCrush{}.tools.youngs_modulus_pa);
  const std::string text = to_json(lab.value().test).dump();
  const Result<Test> back = test_from_json(json::parse(text));
  REQUIRE(back.ok());
  CHECK(to_json(back.value()).dump() == text);
}

TEST_CASE("faults of a pellet crush are named in the words of its file, all in one message") {
  json lab = template_of_pellet_lab();
  lab["apparatus"]["die_diameter_mm"] = 10;
  CHECK(test::says(test::at(faults_of_pellet_lab(lab), "grains.radius_mm"), "few granules"));
  lab = template_of_pellet_lab();
  lab["apparatus"]["press_speedup"] = 1e5;
  lab["apparatus"]["pressed_height_mm"] = 40;
  CHECK(test::says(test::at(faults_of_pellet_lab(lab), "apparatus.press_speedup"), "sound in a bed"));
  CHECK(test::says(test::at(faults_of_pellet_lab(lab), "apparatus.pressed_height_mm"), "above the fill height"));
  lab = template_of_pellet_lab();
  lab["grains"]["largest_mm"] = 1.0501;
  CHECK(
      test::says(test::at(faults_of_pellet_lab(lab), "grains.standard_deviation_mm"), "between smallest and largest"));
  lab = template_of_pellet_lab();
  lab["grains"]["smallest_mm"] = 1.4;
  CHECK(test::says(test::at(faults_of_pellet_lab(lab), "grains.smallest_mm"), "not in order"));
  lab = template_of_pellet_lab();
  lab["apparatus"].erase("punch_speed_mm_s");
  CHECK_FALSE(test::at(faults_of_pellet_lab(lab), "apparatus.punch_speed_mm_s").what.empty());
}

TEST_CASE("granules of the same surface energy over radius are as sticky, whatever their size") {
  const Result<Lab> lab = lab_from_json(template_of_pellet_lab(), ".");
  REQUIRE(lab.ok());
  Test fine = lab.value().test, coarse = fine;
  specimen_of(fine).contact.normal = specimen_of(coarse).contact.normal = NormalLaw::jkr;
  specimen_of(coarse).grains = enlarged(specimen_of(fine).grains, 2);
  std::vector<double> values = default_values();
  fine = with_contact_of(fine, values);
  coarse = with_contact_of(coarse, values);
  CHECK(specimen_of(coarse).contact.surface_energy_j_m2 == Approx(2 * specimen_of(fine).contact.surface_energy_j_m2));
  CHECK(enlarged(specimen_of(fine).contact, 2).surface_energy_j_m2 ==
        Approx(specimen_of(coarse).contact.surface_energy_j_m2));
}

}  // namespace
}  // namespace pastefit
