
#include <bit>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calibrate/card/card.h"
#include "calibrate/card/card_versions.h"
#include "calibrate/card/rescale.h"
#include "calibrate/report/card_text.h"
#include "calibrate/report/summary.h"
#include "calibrate/study/parameters.h"

using namespace pastefit;

namespace {

Card card() {
  Card out;
  out.title = "Mix 20";
  for (const auto& kind : parameter_kinds())
    out.parameters.push_back({std::string(kind.name), false, kind.usual, 0, 0, kind.scale});
  out.parameters[0].free = true;
  out.parameters[0].value = 3000.0 / 7;
  out.parameters[0].lower = 200;
  out.parameters[0].upper = 60000;
  std::vector<double> values;
  for (const auto& parameter : out.parameters) values.push_back(parameter.value);
  out.test = with_contact_of(with_usual_contact(out.test), values);
  std::get<SlumpTest>(out.test).drop = DropPlate{};
  out.grain_density_kg_m3 = 2238 / 0.6;
  out.observables = {{"step1.height_mm", 151.3, 2.5, 150.0, 7.5, 3, 1, 5}, {"step1.spread_mm", 400, 4, {}, 0, 0, 0}};
  out.confirmation = {{18446744073709551615u, 9007199254740993u, 3, 4}, true, 0.26, true};
  out.search = {"default", "confirmed", "It fits.", 42, {1, 2}, 60, 38, {{"never_settled", 2}}};
  auto& provenance = out.provenance;
  provenance.study_file = "study.json";
  provenance.study_hash = "0123456789abcdef";
  provenance.lab_file = "lab.json";
  provenance.lab_hash = "fedcba9876543210";
  provenance.lab.source = "UCI";
  provenance.lab.twin = true;
  provenance.program = "pastefit 0.1.0 engine 00";
  out.baseline.program = provenance.program;
  out.baseline.machine = "x86_64 glibc 2.36";
  for (const std::uint64_t packing : {3, 4}) {
    Observables readings;
    readings.set("step1.height_mm", 150 + 1.0 / static_cast<double>(packing));
    out.baseline.runs.push_back({packing, readings});
  }
  return out;
}

nlohmann::json text_and_back(const nlohmann::ordered_json& json) {
  return nlohmann::json::parse(json.dump(2));
}

}  // namespace

TEST_CASE("a card reads back as it was written, to the last bit") {
  const auto written = card();
  const auto document = to_json(written);
  const auto read = card_from_json(text_and_back(document));
  INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == document.dump());
  CHECK(std::bit_cast<std::uint64_t>(specimen_of(read.value().test).contact.bridge.a_n_m2) ==
        std::bit_cast<std::uint64_t>(specimen_of(written.test).contact.bridge.a_n_m2));
  CHECK(read.value().confirmation.packings == written.confirmation.packings);
  CHECK(read.value().provenance.lab.twin);
}

TEST_CASE("a card states differences and standard errors") {
  const auto document = to_json(card());
  const auto& height = document["observables"]["step1.height_mm"];
  CHECK(height["difference"].get<double>() == Approx(1.3));
  CHECK(height["standard_error"].get<double>() == Approx(1.25));
  CHECK(document["observables"]["step1.spread_mm"]["measured"].is_null());
}

TEST_CASE("a parameter that a card does not name has its usual value") {
  auto document = text_and_back(to_json(card()));
  for (const auto* name : {"curvature", "mould_cohesion_factor"}) document["parameters"].erase(name);
  const auto read = card_from_json(document);
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == to_json(card()).dump());
  document["parameters"].erase("strength_pa");  // it was fitted: the laws in SI say another one
  CHECK_FALSE(card_from_json(document).ok());
}

TEST_CASE("a card with faults names every one of them with its place") {
  auto document = text_and_back(to_json(card()));
  document["parameters"]["curvature"] = "flat";
  document["test"]["grains"]["radius_m"] = "8 mm";
  document["search"]["sead"] = 3;
  document["confirmation"]["packings"] = {1, -2};
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + "\n";
  CHECK_THAT(places, Catch::Contains("parameters.curvature") && Catch::Contains("test.grains.radius_m") &&
                         Catch::Contains("search.sead") && Catch::Contains("confirmation.packings"));
  CHECK(read.faults().size() == 4);
}

TEST_CASE("a card whose two forms of the law differ was edited in one place, and says where") {
  const auto written = text_and_back(to_json(card()));
  auto document = written;
  document["test"]["contact"]["friction"] = 0.31;
  document["test"]["contact"]["bridge"]["c_n"] = written["test"]["contact"]["bridge"]["c_n"].get<double>() * 1.0001;
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + " ";
  CHECK(places == "test.contact.bridge.c_n test.contact.friction ");
  document = written;
  document["parameters"]["strength_pa"] = 1.0001 * written["parameters"]["strength_pa"].get<double>();
  CHECK_FALSE(card_from_json(document).ok());
}

TEST_CASE("a card without its test, and another kind of file, are faults") {
  auto document = text_and_back(to_json(card()));
  document.erase("test");
  CHECK_FALSE(card_from_json(document).ok());
  document["format"] = "pastefit-lab-1";
  CHECK_FALSE(card_from_json(document).ok());
  CHECK_FALSE(card_from_json(nlohmann::json(3)).ok());
  CHECK_FALSE(read_card("/nowhere/card.json").ok());
}

TEST_CASE("the verdict says whether the material meets the laboratory, and whether that was confirmed") {
  auto material = card();
  CHECK_THAT(verdict_of(material), Catch::Contains("meets the laboratory") && Catch::Contains("1.30 mm"));
  material.confirmation.meets_laboratory = false;
  CHECK_THAT(verdict_of(material), Catch::Contains("not sure that the material meets"));
  material.confirmation.misfit = 1.04;
  CHECK_THAT(verdict_of(material), Catch::Contains("does not meet"));
  material.confirmation.fresh = false;
  CHECK_THAT(verdict_of(material), Catch::Contains("Not confirmed"));
  CHECK_THAT(summary_of(material), Catch::Contains("a_n_m2") && Catch::Contains("strength_pa") &&
                                       Catch::Contains("2 failed (never_settled)") && Catch::Contains("twin"));
}

TEST_CASE(
    "people are told the misfit in mm where all that is fitted are lengths of one tolerance, else in tolerances") {
  auto material = card();
  CHECK_THAT(verdict_of(material), Catch::Contains("1.30 mm over 4 packings, asked for 5.00 mm"));
  material.observables.push_back({"fill.mass_kg", 9.1, 0.1, 9.0, 0.1, 1, 0, 0.1});
  CHECK_THAT(verdict_of(material), Catch::Contains("1.30 mm"));  // the mass is not fitted
  material.observables.back().weight = 1;
  CHECK_THAT(verdict_of(material), Catch::Contains("0.26 tolerances over 4 packings, asked for 1.00 tolerances"));
  material.observables.back() = {"step2.height_mm", 90, 2, 91, 7, 1, 1, 5};
  CHECK_THAT(verdict_of(material), Catch::Contains("1.30 mm"));
  material.observables.back().tolerance = 2;
  CHECK_THAT(verdict_of(material), Catch::Contains("tolerances"));
}

TEST_CASE("the summary counts the fillings that sheared off, with the mean with and without them") {
  auto material = card();
  std::get<SlumpTest>(material.test).mould.base_radius_m = 0.1;
  material.baseline.runs.clear();
  for (const auto& [height, shift] : {std::pair{90.0, 12.0}, {94.0, 18.0}, {110.0, 55.0}}) {
    Baseline::Run run;
    run.packing = material.baseline.runs.size() + 1;
    run.observables.set("step1.height_mm", height);
    run.observables.set("step1.lateral_shift_mm", shift);
    material.baseline.runs.push_back(run);
  }
  CHECK_THAT(summary_of(material), Catch::Contains("1 of 3 packings sheared off") &&
                                       Catch::Contains("98.0 mm with them") && Catch::Contains("92.0 mm without"));
  material.baseline.runs.pop_back();
  CHECK_THAT(summary_of(material), !Catch::Contains("sheared"));
}

TEST_CASE("a card of every version ever written is read, and keeps its numbers") {
  const auto folder = std::filesystem::path(PASTEFIT_SOURCE_DIR) / "tests/calibrate/card/versions";
  for (int version = 1; version <= kCardVersion; ++version) {
    INFO("version " << version);
    const auto file = folder / ("card-" + std::to_string(version) + ".json");
    const auto read = read_card(file);
    INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
    REQUIRE(read.ok());
    const auto written = nlohmann::json::parse(std::ifstream(file));
    CHECK(written["format"] == "pastefit-card-" + std::to_string(version));
    auto again = text_and_back(to_json(read.value()));
    CHECK(again["format"] == "pastefit-card-" + std::to_string(kCardVersion));
    const auto before = written.flatten(), flat = again.flatten();
    for (const auto& [place, value] : before.items()) {
      INFO(place);
      if (place != "/format" && !place.ends_with("_mm") && !place.starts_with("/provenance"))
        CHECK(flat.value(place, nlohmann::json("absent")) == value);
    }
    CHECK(again["confirmation"]["misfit"].get<double>() * 5 == Approx(0.040223408152215256));
    for (const auto& [name, observable] : again["observables"].items())
      CHECK(observable.value("tolerance", 0.0) == (observable["measured"].is_null() ? 0 : 5));
  }
}

TEST_CASE("readings of a card that no heap of its test can have are refused, each with its place") {
  const auto good = text_and_back(to_json(card()));
  auto bad = good;
  bad["observables"]["step1.height_mm"]["simulated"] = 2000;  // in a mould of 200 mm
  bad["observables"]["step1.height_mm"]["measured"] = -5;
  bad["baseline"]["readings"]["step1.height_mm"][1] = -150;
  const auto read = card_from_json(bad);
  REQUIRE_FALSE(read.ok());
  REQUIRE(read.faults().size() == 3);
  CHECK(read.faults()[0].where == "observables.step1.height_mm.simulated");
  CHECK(read.faults()[1].where == "observables.step1.height_mm.measured");
  CHECK_THAT(read.faults()[2].where, Catch::StartsWith("baseline.readings.step1.height_mm"));
  bad = good;
  bad["observables"]["step1.another_mm"] = bad["observables"]["step1.spread_mm"];  // of another version
  bad["observables"]["step1.another_mm"]["simulated"] = -7000;
  CHECK(card_from_json(bad).ok());
}

TEST_CASE("a card of a newer version, of none, and one cut short are refused with a reason") {
  auto document = text_and_back(to_json(card()));
  document["format"] = "pastefit-card-99";
  auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  CHECK_THAT(read.faults()[0].remedy, Catch::Contains("newer"));
  for (const auto* format : {"pastefit-card-", "pastefit-card-0", "pastefit-card-2x", "pastefit-card--1"}) {
    document["format"] = format;
    CHECK_FALSE(card_from_json(document).ok());
  }
  document["format"] = "pastefit-card-2";
  document.erase("baseline");
  read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  CHECK(read.faults()[0].where == "baseline");
}

TEST_CASE("intervals, correlations, what is not identified and the history of a card are kept") {
  auto written = card();
  auto& inference = written.inference;
  inference.method = "profile";
  inference.level = 0.95;
  inference.intervals = {{"strength_pa", 300, 900}};
  inference.correlations = {{"strength_pa", "curvature", -0.75}};
  inference.not_identified = {{"offset_ratio", "no reading moves with it"}};
  written.rebaselined = {{"the fill was mended", "a", "b", {{"step1.height_mm", 150, 152}}}};
  written.rescaled = {{0.01, {{"step1.height_mm", 150, 140, 2}}}};
  const auto document = to_json(written);
  const auto read = card_from_json(text_and_back(document));
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == document.dump());
  CHECK(read.value().inference.correlations.at(0).value == -0.75);
  CHECK(read.value().baseline.runs.at(1).packing == 4);
  const auto text = text_of(read.value());
  for (const auto* words : {"95 %", "300 to 900", "-0.75 with curvature", "no reading moves with it",
                            "the fill was mended", "grains of 10 mm", "bias -10"})
    CHECK_THAT(text, Catch::Contains(words));
}

TEST_CASE("the other tests of a study, its hold-outs and what was known beforehand are kept and shown") {
  auto written = card();
  written.test_name = "cone";
  written.parameters[0].prior = Prior{400, 100};
  CardTest fitted;
  fitted.name = "plate";
  fitted.lab_file = "plate.json";
  fitted.lab_hash = "00000000000000aa";
  fitted.test = written.test;
  std::get<SlumpTest>(fitted.test).mould.height_m = 0.2;
  fitted.observables = {{"step1.height_mm", 80, 2, 83.0, 4, 3, 1, 5}};
  CardTest held = fitted;
  held.name = "fast";
  held.hold_out = true;
  held.observables[0].band = 1.5;
  held.within_noise = false;
  written.further = {fitted, held};
  const auto document = to_json(written);
  const auto read = card_from_json(text_and_back(document));
  INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == document.dump());
  const auto summary = summary_of(read.value());
  for (const auto* words : {"Test cone", "Test plate\n", "Test fast, held out", "noise explains +-1.5",
                            "Hold-out fast: not predicted", "known as 400 +- 100"})
    CHECK_THAT(summary, Catch::Contains(words));
  auto spoiled = text_and_back(document);
  spoiled["further_tests"][1]["test"].erase("mould");
  spoiled["further_tests"][0]["observables"]["step1.height_mm"]["band"] = -1;
  const auto refused = card_from_json(spoiled);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.faults().size() == 2);
  CHECK(refused.faults()[0].where.find("further_tests[") == 0);
}

TEST_CASE("faults in the later parts of a card are named with their place") {
  auto document = text_and_back(to_json(card()));
  document["baseline"]["readings"]["step1.height_mm"] = {1};
  document["intervals"] = {{"method", "x"}, {"level", 2}, {"parameters", {{"strength_pa", {{"lower", 1}}}}}};
  document["correlation"] = {{"strength_pa", {{"curvature", 3}}}};
  document["rebaselined"] = {3};
  document["rescaled"] = "no";
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + "\n";
  for (const auto* place :
       {"baseline.readings.step1.height_mm", "intervals.level", "intervals.parameters.strength_pa.upper",
        "correlation.strength_pa.curvature", "rebaselined[0]", "rescaled"})
    CHECK_THAT(places, Catch::Contains(place));
  CHECK(read.faults().size() == 6);
}

TEST_CASE("a card carried to another grain size is the same law in scale-free numbers") {
  const auto before = card();
  const double radius = specimen_of(before.test).grains.radius_m;
  const auto result = rescaled(before, radius / 2);
  REQUIRE(result.ok());
  const auto& after = result.value();
  std::vector<double> values;
  for (const auto& parameter : after.parameters) values.push_back(parameter.value);
  const Test fitted_anew = with_contact_of(after.test, values);
  const ContactModel& expected = specimen_of(fitted_anew).contact;
  CHECK(specimen_of(after.test).grains.radius_m == radius / 2);
  CHECK(specimen_of(after.test).contact.bridge.a_n_m2 == Approx(expected.bridge.a_n_m2));
  CHECK(specimen_of(after.test).contact.bridge.b_n_m == Approx(expected.bridge.b_n_m));
  CHECK(specimen_of(after.test).contact.bridge.c_n == Approx(expected.bridge.c_n));
  CHECK(specimen_of(after.test).contact.bridge.d_c_m == Approx(expected.bridge.d_c_m));
  CHECK(specimen_of(after.test).contact.bridge.offset_m == Approx(expected.bridge.offset_m));
  CHECK(*specimen_of(after.test).contact.cohesion_n == Approx(*expected.cohesion_n));
  CHECK(after.observables.empty());
  CHECK_FALSE(after.confirmation.meets_laboratory);
  CHECK_FALSE(rescaled(before, 0.1).ok());
}
