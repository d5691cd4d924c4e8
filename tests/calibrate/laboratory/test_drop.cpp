#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/calibrate.h"
#include "calibrate/card/card.h"
#include "calibrate/check/check.h"
#include "calibrate/store/program.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"
#include "tests/calibrate/files.h"
#include "tests/calibrate/folder.h"

namespace pastefit {
namespace {

using nlohmann::json;

json template_of_lab() {
  return json::parse(template_text("drop-lab").value(), nullptr, true, true);
}

Faults faults_of(const json& lab) {
  const Result<Lab> read = lab_from_json(lab, ".");
  return read.ok() ? Faults{} : read.faults();
}

TEST_CASE("a drop test is read in millimetres and degrees, and survives JSON bit for bit") {
  const Result<Lab> lab = lab_from_json(template_of_lab(), ".");
  INFO((lab.ok() ? "" : message_of(lab.faults())));
  REQUIRE(lab.ok());
  const auto& test = std::get<DropTest>(lab.value().test);
  CHECK(test.drop_height_m == 0.5);
  CHECK(test.plate_tilt_rad == Approx(0.698132));
  CHECK(test.grains.radius_m == 0.01);
  const std::string text = to_json(lab.value().test).dump();
  const Result<Test> back = test_from_json(json::parse(text));
  REQUIRE(back.ok());
  CHECK(to_json(back.value()).dump() == text);
}

TEST_CASE("faults of a drop test are named in the words of its file") {
  json lab = template_of_lab();
  lab["apparatus"]["drop_height_mm"] = 0.5;
  CHECK_FALSE(test::at(faults_of(lab), "apparatus.drop_height_mm").what.empty());
  lab = template_of_lab();
  lab["apparatus"].erase("plate_tilt_deg");
  CHECK(test::says(test::at(faults_of(lab), "measurements.tilted.spin_rad_s"), "not tilted"));
  lab = template_of_lab();
  lab["grains"] = {{"distribution", "uniform"}, {"smallest_mm", 8}, {"largest_mm", 12}};
  CHECK(test::says(test::at(faults_of(lab), "grains.distribution"), "one ball falls"));
  lab = template_of_lab();
  lab["apparatus"]["preset"] = "abrams";
  CHECK(test::says(test::at(faults_of(lab), "apparatus.preset"), "another test"));
}

TEST_CASE("restitution and friction of the drop twin are found, confirmed, and lie where they are told to",
          "[campaign]") {
  const test::Folder folder;
  const Study study = read_study(PASTEFIT_SOURCE_DIR "/data/studies/drop-twin.json").value();
  Store store = Store::open(folder.path() / "evaluations.sqlite", {program_identity(), "twin"}).value();
  const CalibrationResult result = calibrate(study, store).value();
  INFO(result.search.reason);
  CHECK(result.search.status == CalibrationStatus::confirmed);
  const Card& card = result.card.value();
  CHECK(card.confirmation.meets_laboratory);
  CHECK(card.tests[0].lab.twin);
  CHECK(card.material.grain_density_kg_m3 == 2500);
  for (const ParameterInterval& one : result.inference.value().intervals) {
    const double truth = one.parameter.name == "restitution" ? 0.9 : 0.08;
    INFO(one.parameter.name << " between " << one.lower.at << " and " << one.upper.at);
    CHECK(one.interval_exists());
    CHECK(one.lower.at < truth);
    CHECK(one.upper.at > truth);
    CHECK(one.upper.at - one.lower.at < 0.1);
  }
}

TEST_CASE("a material from another test is held against a drop test, with the ball's own size") {
  Card card;
  std::vector<double> values;
  for (const ParameterKind& kind : parameter_kinds()) {
    const bool known = kind.name == "restitution" || kind.name == "strength_pa" || kind.name == "youngs_modulus_pa";
    const double value = kind.name == "restitution" ? 0.8 : kind.name == "strength_pa" ? 1 : 1e9;
    values.push_back(known ? value : kind.default_value);
    card.material.parameters.push_back({std::string(kind.name), false, values.back(), 0, 0, kind.scale});
  }
  Test& slump = card.tests.emplace_back().test;
  slump = with_contact_of(with_default_contact(slump), values);
  card.material.grains = specimen_of(slump).grains;
  card.material.contact = specimen_of(slump).contact;
  json document = template_of_lab();
  document["grains"]["radius_mm"] = 100;  // no mould would take it
  document["measurements"] = {{"level.rebound_height_mm", {{"value", 320}, {"standard_deviation", 2}}}};
  const auto agrees = [&] {
    const Result<Lab> lab = lab_from_json(document, ".");
    INFO((lab.ok() ? "" : message_of(lab.faults())));
    REQUIRE(lab.ok());
    return check_against(card, lab.value(), {}, CheckEngine::ours()).verdict;
  };
  CHECK(agrees() == CheckVerdict::agrees);
  document["measurements"]["level.rebound_height_mm"]["value"] = 400;
  CHECK(agrees() == CheckVerdict::disagrees);
}

TEST_CASE("the ball keeps its size: no rescaling, no coarse grains") {
  Card card;
  card.tests.emplace_back().test = DropTest{};
  card.material.grains = specimen_of(card.tests[0].test).grains;
  const Result<Card> finer = rescaled(card, 0.004);
  REQUIRE_FALSE(finer.ok());
  CHECK(test::says(test::at(finer.faults(), "tests[0].test"), "as large as the laboratory's"));
  Study study;
  study.tests.resize(2);
  study.tests[1].lab.test = DropTest{};
  const Study coarse = with_coarse_grains(study);
  CHECK(specimen_of(coarse.tests[0].lab.test).grains.radius_m > 0.008);
  CHECK(specimen_of(coarse.tests[1].lab.test).grains.radius_m == 0.008);
}

}  // namespace
}  // namespace pastefit
