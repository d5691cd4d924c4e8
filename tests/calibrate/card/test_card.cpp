
#include <bit>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calibrate/card/card.h"
#include "calibrate/card/standing.h"
#include "calibrate/report/summary.h"
#include "calibrate/study/parameters.h"
#include "tests/calibrate/card/as_text.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;

namespace {

Card card() {
  Card out;
  out.title = "Mix 20";
  auto& parameters = out.material.parameters;
  for (const auto& kind : parameter_kinds())
    parameters.push_back({std::string(kind.name), false, kind.default_value, 0, 0, kind.scale});
  parameters[0].free = true;
  parameters[0].value = 3000.0 / 7;
  parameters[0].lower = 200;
  parameters[0].upper = 60000;
  auto& test = out.tests.emplace_back();
  test.test = with_contact_of(with_default_contact(test.test), values_of(out.material));
  std::get<SlumpTest>(test.test).drop = DropPlate{};
  out.material.bulk_density_kg_m3 = specimen_of(test.test).bulk_density_kg_m3;
  out.material.grain_density_kg_m3 = 2238 / 0.6;
  out.material.grains = specimen_of(test.test).grains;
  out.material.contact = specimen_of(test.test).contact;
  test.readings = {{"step1.height_mm", {4, 151.3, 2.5}, 150.0, 7.5, 3, 1, 5},
                   {"step1.spread_mm", {4, 400, 4}, {}, 0, 0, 0}};
  out.confirmation = {{18446744073709551615u, 9007199254740993u, 3, 4}, true, 0.26, true};
  out.search = {"default", "confirmed", "It fits.", 42, {1, 2}, 60, 38, {{"never_settled", 2}}};
  out.provenance = {"study.json", "0123456789abcdef", "pastefit 0.1.0 engine 00"};
  test.lab_file = "lab.json";
  test.lab_hash = "fedcba9876543210";
  test.lab.source = "UCI";
  test.lab.twin = true;
  test.baseline.program = out.provenance.program;
  test.baseline.machine = "x86_64 glibc 2.36";
  for (const std::uint64_t packing : {3, 4}) {
    Readings readings;
    readings.set("step1.height_mm", 150 + 1.0 / static_cast<double>(packing));
    test.baseline.runs.push_back({packing, readings});
  }
  return out;
}

}  // namespace

TEST_CASE("a card reads back as it was written, to the last bit") {
  const auto written = card();
  const auto document = to_json(written);
  const auto read = card_from_json(text_and_back(document));
  INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == document.dump());
  CHECK(std::bit_cast<std::uint64_t>(specimen_of(read.value().tests[0].test).contact.bridge.a_n_m2) ==
        std::bit_cast<std::uint64_t>(specimen_of(written.tests[0].test).contact.bridge.a_n_m2));
  CHECK(read.value().confirmation.packings == written.confirmation.packings);
  CHECK(read.value().tests[0].lab.twin);
}

TEST_CASE("a card keeps a measured yield stress, and holds what its readings say beside it") {
  auto material = card();
  auto& test = material.tests[0];
  const auto none = with_yield_stresses(material);
  CHECK_FALSE(none["tests"][0].contains("measured_yield_stress_pa"));
  const auto& height = none["tests"][0]["yield_stress_pa"]["step1.height_mm"];
  CHECK(height["formula"] == "Schowalter 1998");
  CHECK(height["measured"] < height["simulated"]);  // 150.0 and 151.3 mm
  CHECK_FALSE(height.contains("ratio"));
  CHECK_FALSE(none["tests"][0]["yield_stress_pa"]["step1.spread_mm"].contains("measured"));

  const double simulated_pa = height["simulated"];
  test.yield_stress = Measurement{"yield_stress_pa", simulated_pa / 2, simulated_pa / 8, 3};
  const auto document = with_yield_stresses(material);
  const auto& beside = document["tests"][0]["yield_stress_pa"]["step1.height_mm"];
  CHECK(beside["ratio"].get<double>() == Approx(2));
  CHECK(beside["deviations"].get<double>() == Approx(4));
  const auto read = card_from_json(text_and_back(document));
  REQUIRE(read.ok());
  CHECK(with_yield_stresses(read.value()).dump() == document.dump());
  CHECK_FALSE(to_json(read.value())["tests"][0].contains("yield_stress_pa"));  // derived, not stored
  CHECK_THAT(summary_of(material),
             Catch::Contains("by step1.height_mm: 2 times the measured one, +4 standard deviations") &&
                 Catch::Contains("by step1.spread_mm: "));
}

TEST_CASE("a card states differences and standard errors") {
  const auto document = to_json(card());
  const auto& height = document["tests"][0]["readings"]["step1.height_mm"];
  CHECK(height["difference"].get<double>() == Approx(1.3));
  CHECK(height["standard_error"].get<double>() == Approx(1.25));
  CHECK(document["tests"][0]["readings"]["step1.spread_mm"]["measured"].is_null());
}

TEST_CASE("a card keeps of how many packings a reading is where a laboratory would reject the others") {
  Card material = card();
  material.tests[0].readings[0].simulated.count = 3;
  const auto document = to_json(material);
  const auto& readings = document["tests"][0]["readings"];
  CHECK(readings["step1.height_mm"]["packings"] == 3);
  CHECK(readings["step1.height_mm"]["standard_error"].get<double>() == Approx(2.5 / std::sqrt(3.0)));
  CHECK_FALSE(readings["step1.spread_mm"].contains("packings"));
  const auto read = card_from_json(document);
  REQUIRE(read.ok());
  CHECK(read.value().tests[0].readings[0].simulated.count == 3);
  CHECK(read.value().tests[0].readings[1].simulated.count == 4);
  CHECK_THAT(verdict_of(material), Catch::Contains("(mean of 3 of 4 packings)"));
}

TEST_CASE("a parameter that a card does not name has its default value") {
  auto document = text_and_back(to_json(card()));
  for (const auto* name : {"curvature", "mould_cohesion_factor"}) document["material"]["parameters"].erase(name);
  const auto read = card_from_json(document);
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == to_json(card()).dump());
  document["material"]["parameters"].erase("strength_pa");  // it was fitted: the laws in SI say another one
  CHECK_FALSE(card_from_json(document).ok());
}

TEST_CASE("a card with faults names every one of them with its place") {
  auto document = text_and_back(to_json(card()));
  document["material"]["parameters"]["curvature"] = "flat";
  document["material"]["grains"]["radius_m"] = "8 mm";
  document["search"]["sead"] = 3;
  document["confirmation"]["packings"] = {1, -2};
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + "\n";
  CHECK_THAT(places, Catch::Contains("material.parameters.curvature") && Catch::Contains("material.grains.radius_m") &&
                         Catch::Contains("search.sead") && Catch::Contains("confirmation.packings"));
  CHECK(read.faults().size() == 4);
}

TEST_CASE("a card whose two forms of the law differ was edited in one place, and says where") {
  const auto written = text_and_back(to_json(card()));
  auto document = written;
  auto& contact = document["material"]["contact"];
  contact["friction"] = 0.31;
  contact["bridge"]["c_n"] = contact["bridge"]["c_n"].get<double>() * 1.0001;
  document["tests"][0]["test"]["mould_wall"]["friction"] = 0.7;
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + " ";
  CHECK(places == "material.contact.bridge.c_n material.contact.friction tests[0].test.mould_wall.friction ");
  document = written;
  document["material"]["parameters"]["strength_pa"] = 1.0001 * 3000.0 / 7;
  CHECK_FALSE(card_from_json(document).ok());
}

TEST_CASE("a card without its material, and another kind of file, are faults") {
  auto document = text_and_back(to_json(card()));
  document.erase("material");
  CHECK_FALSE(card_from_json(document).ok());
  document["format"] = "pastefit-lab-1";
  CHECK_FALSE(card_from_json(document).ok());
  CHECK_FALSE(card_from_json(nlohmann::json(3)).ok());
  CHECK_FALSE(read_card("/nowhere/card.json").ok());
}

TEST_CASE("the verdict says whether the material meets the laboratory, and whether that was confirmed") {
  auto material = card();
  CHECK_THAT(verdict_of(material), Catch::Contains("reproduces the measurement") && Catch::Contains("1.30 mm"));
  material.confirmation.meets_laboratory = false;
  CHECK_THAT(verdict_of(material), Catch::Contains("uncertain whether the material reproduces"));
  material.confirmation.refuted = true;  // e.g. all heaps shear off, however well they read
  CHECK_THAT(verdict_of(material), Catch::Contains("The readings are within their tolerances, but "));
  CHECK(card_from_json(text_and_back(to_json(material))).value().confirmation.refuted);
  material.confirmation.refuted = false;
  material.confirmation.error = 1.04;
  CHECK_THAT(verdict_of(material), Catch::Contains("does not reproduce"));
  material.confirmation.fresh = false;
  CHECK_THAT(verdict_of(material), Catch::Contains("Not confirmed"));
  material.confirmation.packings.clear();  // carried over to other grains, and not simulated there
  CHECK_THAT(verdict_of(material), Catch::StartsWith("Not simulated.") && !Catch::Contains("largest error"));
  CHECK_THAT(summary_of(material), Catch::Contains("Type this into") && Catch::Contains("strength_pa") &&
                                       Catch::Contains("2 failed (never_settled)") && Catch::Contains("twin"));
}

TEST_CASE(
    "people are told the misfit in mm where all that is fitted are lengths of one tolerance, else in tolerances") {
  auto material = card();
  CHECK_THAT(verdict_of(material), Catch::Contains("largest error 1.30 mm of the 5 mm allowed (mean of 4 packings)"));
  material.tests[0].readings.push_back({"fill.mass_kg", {4, 9.1, 0.1}, 9.0, 0.1, 1, 0, 0.1});
  CHECK_THAT(verdict_of(material), Catch::Contains("1.30 mm"));  // the mass is not fitted
  material.tests[0].readings.back().weight = 1;
  CHECK_THAT(verdict_of(material), Catch::Contains("largest error 0.26 of its tolerance (mean of 4 packings)"));
  material.tests[0].readings.back() = {"step2.height_mm", {1, 90, 2}, 91, 7, 1, 1, 5};
  CHECK_THAT(verdict_of(material), Catch::Contains("1.30 mm"));
  material.tests[0].readings.back().tolerance = 2;
  CHECK_THAT(verdict_of(material), Catch::Contains("of its tolerance"));
}

TEST_CASE("the summary counts the packings that sheared off, with the mean with and without them") {
  auto material = card();
  std::get<SlumpTest>(material.tests[0].test).mould.base_radius_m = 0.1;
  auto& runs = material.tests[0].baseline.runs;
  runs.clear();
  for (const auto& [height, shift] : {std::pair{90.0, 12.0}, {94.0, 18.0}, {110.0, 55.0}}) {
    Baseline::Run run;
    run.packing = runs.size() + 1;
    run.readings.set("step1.height_mm", height);
    run.readings.set("step1.lateral_shift_mm", shift);
    runs.push_back(run);
  }
  CHECK_THAT(summary_of(material), Catch::Contains("1 of 3 heaps sheared off (95 % interval of the share: 1 to 91 %") &&
                                       Catch::Contains("With them, the height") && Catch::Contains("would be 98.0 mm"));
  runs.pop_back();
  CHECK_THAT(summary_of(material), !Catch::Contains("sheared"));
}

TEST_CASE("a card with a kind of test that this program does not know says so once, with its place") {
  const auto file = std::filesystem::path(PASTEFIT_SOURCE_DIR) / "tests/calibrate/card/several_tests.json";
  auto document = text_and_back(to_json(read_card(file).value()));
  document["tests"][1]["test"]["kind"] = "pellet_crush";
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  REQUIRE(read.faults().size() == 1);
  CHECK(read.faults()[0].where == "tests[1].test.kind");
  CHECK_THAT(read.faults()[0].what, Catch::Contains("pellet_crush"));
  CHECK_THAT(read.faults()[0].remedy, Catch::Contains("slump"));
}

TEST_CASE("a fault of the material is said once, however many tests have it") {
  auto document = text_and_back(to_json(card()));
  document["tests"].push_back(document["tests"][0]);
  document["tests"][0]["name"] = "one";
  document["tests"][1]["name"] = "two";
  const auto good = document;
  REQUIRE(card_from_json(good).ok());
  const auto places = [](const nlohmann::json& spoiled) {
    const auto read = card_from_json(spoiled);
    std::string all;
    for (const auto& fault : read.ok() ? Faults{} : read.faults()) all += fault.where + " ";
    return all;
  };
  document["material"]["contact"]["frction"] = 1;
  document["material"]["grains"].erase("radius_m");
  CHECK(places(document) == "material.grains.radius_m material.contact.frction ");
  document = good;
  document["material"]["contact"]["youngs_modulus_pa"] = -1;  // an admissible number as a form, not as a law
  CHECK(places(document) == "material.contact.youngs_modulus_pa ");
  document = good;
  document["material"]["contact"]["friction"] = 0.31;
  CHECK(places(document) == "material.contact.friction ");
  document = good;
  document["material"].erase("contact");
  CHECK(places(document) == "material.contact ");
}

TEST_CASE("a card has a test, and of several each has a name of its own") {
  const auto good = text_and_back(to_json(card()));
  const auto fault_of = [](const nlohmann::json& document) {
    const auto read = card_from_json(document);
    REQUIRE_FALSE(read.ok());
    REQUIRE(read.faults().size() == 1);
    return read.faults()[0].where;
  };
  auto document = good;
  document["tests"] = nlohmann::json::array();
  CHECK(fault_of(document) == "tests");
  document.erase("tests");
  CHECK(fault_of(document) == "tests");
  document = good;
  document["tests"][0]["name"] = "one";
  document["tests"].push_back(document["tests"][0]);
  CHECK(fault_of(document) == "tests[1].name");
  document["tests"][1].erase("name");
  CHECK(fault_of(document) == "tests[1].name");
}

TEST_CASE("readings of a card that no heap of its test can have are refused, each with its place") {
  const auto good = text_and_back(to_json(card()));
  auto bad = good;
  auto& test = bad["tests"][0];
  test["readings"]["step1.height_mm"]["simulated"] = 2000;  // in a mould of 200 mm
  test["readings"]["step1.height_mm"]["measured"] = -5;
  test["baseline"]["readings"]["step1.height_mm"][1] = -150;
  const auto read = card_from_json(bad);
  REQUIRE_FALSE(read.ok());
  REQUIRE(read.faults().size() == 3);
  CHECK(read.faults()[0].where == "tests[0].readings.step1.height_mm.simulated");
  CHECK(read.faults()[1].where == "tests[0].readings.step1.height_mm.measured");
  CHECK_THAT(read.faults()[2].where, Catch::StartsWith("tests[0].baseline.readings.step1.height_mm"));
  bad = good;
  auto& readings = bad["tests"][0]["readings"];
  readings["step1.another_mm"] = readings["step1.spread_mm"];  // of another version
  readings["step1.another_mm"]["simulated"] = -7000;
  CHECK(card_from_json(bad).ok());
}

TEST_CASE("intervals, correlations, what is not identified and the history of a card are kept") {
  auto written = card();
  auto& inference = written.inference;
  inference.method = "profile";
  inference.level = 0.95;
  inference.intervals = {{"strength_pa", 300, 900}};
  inference.correlations = {{"strength_pa", {{"curvature", -0.75}}}};
  inference.not_identified = {{"formation_ratio", "no reading moves with it"}};
  written.rebaselined = {{"the fill was mended", "a", "b", {{"step1.height_mm", 150, 152}}}};
  written.rescaled = {{0.01, {{"step1.height_mm", 150, 140, 2}}}};
  written.further_confirmations = {{"lammps",
                                    "LAMMPS 1",
                                    "",
                                    0.003,
                                    {8, 9},
                                    2,
                                    16,
                                    60,
                                    900,
                                    0.75,
                                    true,
                                    {{"step1.height_mm", 150, 147.5, 4, 3.0}, {"step1.spread_mm", 300, 310, 5, {}}}}};
  const auto document = to_json(written);
  const auto read = card_from_json(text_and_back(document));
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == document.dump());
  CHECK(read.value().inference.correlations.at(0).others.at(0).value == -0.75);
  CHECK(read.value().tests[0].baseline.runs.at(1).packing == 4);
  const auto text = text_of(read.value());
  for (const auto* words : {"95 %", "300 to 900", "-0.75 with curvature", "no reading moves with it",
                            "the fill was mended", "grains of 10 mm", "bias -10", "LAMMPS 1", "grains of 3 mm",
                            "ranks: 16", "bias -2.5 +- 3", "bias +10 (error unknown)", "0.75 of its"})
    CHECK_THAT(text, Catch::Contains(words));
}

TEST_CASE("the other tests of a study, its hold-outs and what was known beforehand are kept and shown") {
  auto written = card();
  written.tests[0].name = "cone";
  written.material.parameters[0].prior = Prior{400, 100};
  CardTest fitted;
  fitted.name = "plate";
  fitted.lab_file = "plate.json";
  fitted.lab_hash = "00000000000000aa";
  fitted.test = written.tests[0].test;
  std::get<SlumpTest>(fitted.test).mould.height_m = 0.2;
  fitted.readings = {{"step1.height_mm", {1, 80, 2}, 83.0, 4, 3, 1, 5}};
  CardTest held = fitted;
  held.name = "fast";
  held.hold_out = true;
  held.readings[0].band = 1.5;
  held.within_noise = false;
  written.tests.push_back(fitted);
  written.tests.push_back(held);
  const auto document = to_json(written);
  const auto read = card_from_json(text_and_back(document));
  INFO((read.ok() ? "" : read.faults()[0].where + ": " + read.faults()[0].what));
  REQUIRE(read.ok());
  CHECK(to_json(read.value()).dump() == document.dump());
  const auto summary = summary_of(read.value());
  for (const auto* words : {"Test cone\n", "Test plate\n", "Test fast, validation test", "noise explains +-1.5",
                            "Validation test fast: not predicted", "400 +- 100"})
    CHECK_THAT(summary, Catch::Contains(words));
  auto spoiled = text_and_back(document);
  spoiled["tests"][2]["test"].erase("mould");
  spoiled["tests"][1]["readings"]["step1.height_mm"]["band"] = -1;
  const auto refused = card_from_json(spoiled);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.faults().size() == 2);
  CHECK(refused.faults()[0].where == "tests[1].readings.step1.height_mm.band");
  CHECK(refused.faults()[1].where == "tests[2].test.mould");
}

TEST_CASE("faults in the later parts of a card are named with their place") {
  auto document = text_and_back(to_json(card()));
  document["tests"][0]["baseline"]["readings"]["step1.height_mm"] = {1};
  document["intervals"] = {{"method", "x"}, {"level", 2}, {"parameters", {{"strength_pa", {{"lower", 1}}}}}};
  document["correlation"] = {{"strength_pa", {{"curvature", 3}}}};
  document["rebaselined"] = {3};
  document["rescaled"] = "no";
  document["further_confirmations"] = {{{"engine", "lammps"}, {"ranks", 0}}};
  const auto read = card_from_json(document);
  REQUIRE_FALSE(read.ok());
  std::string places;
  for (const auto& fault : read.faults()) places += fault.where + "\n";
  for (const auto* place :
       {"tests[0].baseline.readings.step1.height_mm", "intervals.level", "intervals.parameters.strength_pa.upper",
        "correlation.strength_pa.curvature", "rebaselined[0]", "rescaled", "further_confirmations[0].ranks",
        "further_confirmations[0].radius_m"})
    CHECK_THAT(places, Catch::Contains(place));
  CHECK(read.faults().size() == 15);
}

TEST_CASE("a card carried to another grain size is the same law in scale-free numbers") {
  const auto before = card();
  const double radius = before.material.grains.radius_m;
  const auto result = rescaled(before, radius / 2);
  REQUIRE(result.ok());
  const auto& after = result.value();
  const Test fitted_anew = with_contact_of(after.tests[0].test, values_of(after.material));
  const ContactModel& expected = specimen_of(fitted_anew).contact;
  CHECK(after.material.grains.radius_m == radius / 2);
  CHECK(specimen_of(after.tests[0].test).grains.radius_m == radius / 2);
  CHECK_FALSE(to_json(after)["tests"][0]["test"].contains("contact"));  // it is the material's as before
  CHECK(after.material.contact.bridge.a_n_m2 == Approx(expected.bridge.a_n_m2));
  CHECK(after.material.contact.bridge.b_n_m == Approx(expected.bridge.b_n_m));
  CHECK(after.material.contact.bridge.c_n == Approx(expected.bridge.c_n));
  CHECK(after.material.contact.bridge.d_c_m == Approx(expected.bridge.d_c_m));
  CHECK(after.material.contact.bridge.offset_m == Approx(expected.bridge.offset_m));
  CHECK(*after.material.contact.cohesion_n == Approx(*expected.cohesion_n));
  CHECK(after.tests[0].readings.empty());
  CHECK_FALSE(after.confirmation.meets_laboratory);
  CHECK_FALSE(rescaled(before, 0.1).ok());
}
