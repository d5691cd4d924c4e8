#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/laws/constants.h"
#include "tests/calibrate/files.h"
#include "tests/calibrate/study/desk.h"

namespace pastefit {
namespace {

using nlohmann::json;
using test::at;
using test::Desk;
using test::says;

TEST_CASE("the templates are read as they are") {
  const Desk desk;
  desk.folder().write("lab.json", template_text("lab").value());
  const Result<Study> study = read_study(desk.folder().write("study.json", template_text("study").value()));
  INFO((study.ok() ? "" : message_of(study.faults())));
  REQUIRE(study.ok());
  CHECK(free_count(study.value()) == 4);
  CHECK(study.value().tests[0].lab.measurements.size() == 2);
  // Heaps that sheared off are counted; radii are spread, because equal spheres shear off.
  CHECK(study.value().search.rejected_share == 0.2);
  CHECK(template_text("lab")->find("\"smallest_mm\": 6, \"largest_mm\": 10") != std::string::npos);
  CHECK_FALSE(template_text("card"));
}

TEST_CASE("every kind of test has two templates that are read as they are, of all its readings") {
  const std::vector<std::string> names = template_names();
  const std::vector<std::string_view> kinds = kinds_of_tests();
  REQUIRE(names.size() == 2 * kinds.size() + 2);  // and the sheets to print
  CHECK(names[0] == "lab");
  CHECK(names[1] == "study");
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    INFO(kinds[i]);
    const Desk desk;
    const std::string lab = template_text(names[2 * i]).value();
    desk.folder().write("lab.json", lab);
    const auto study = read_study(desk.folder().write("study.json", template_text(names[2 * i + 1]).value()));
    INFO((study.ok() ? "" : message_of(study.faults())));
    REQUIRE(study.ok());
    CHECK(kind_of(study.value().tests[0].lab.test) == kinds[i]);
    // A later stage's readings may be named as those of the first, or in full.
    for (const ReadingKind& kind : reading_kinds(study.value().tests[0].lab.test))
      if (!kind.key.empty()) CHECK(lab.find(kind.key.substr(kind.key.find('.'))) != std::string::npos);
  }
}

TEST_CASE("the templates of the lifted cylinder are read as they are: dry grains, whose frictions are free") {
  const Desk desk;
  desk.folder().write("lab.json", template_text("lab-lifted-cylinder").value());
  const auto study = read_study(desk.folder().write("study.json", template_text("study-lifted-cylinder").value()));
  INFO((study.ok() ? "" : message_of(study.faults())));
  REQUIRE(study.ok());
  std::vector<std::string> free;
  for (const Parameter& one : study.value().parameters)
    if (one.free) free.push_back(one.name);
  CHECK(free == std::vector<std::string>{"friction", "rolling_friction"});
  CHECK(study.value().tests[0].lab.notes.empty());
  CHECK_FALSE(template_text("lab-abrams"));
}

TEST_CASE("the shipped studies are read: height and spread to fit where a heap can have both, else the height") {
  int studies = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PASTEFIT_SOURCE_DIR "/data/studies")) {
    if (!entry.path().filename().string().starts_with("concrete-mix-")) continue;
    const Result<Study> study = read_study(entry.path());
    INFO((study.ok() ? "" : message_of(study.faults())));
    REQUIRE(study.ok());
    ++studies;
    CHECK(study.value().tests[0].lab.provenance.licence == "CC BY 4.0");
    const std::string name = entry.path().stem();
    const bool both = name != "concrete-mix-02" && name != "concrete-mix-20" && name != "concrete-mix-103";
    const auto& targets = study.value().tests[0].targets;
    REQUIRE(targets.size() == (both ? 2 : 3));  // heaps that shear off are counted; of the others the shift is shown
    CHECK(targets[0].reading == "step1.height_mm");
    CHECK(targets[0].weight == 1);
    CHECK(targets.back().reading == "step1.spread_mm");
    CHECK(targets.back().weight == (both ? 1 : 0));
    if (!both) CHECK(targets[1].weight == 0);
    CHECK(free_count(study.value()) == 5);
  }
  CHECK(studies == 9);
}

TEST_CASE("what a study does not name has its default value") {
  const Result<Study> read = Desk().read(Desk::study());
  REQUIRE(read.ok());
  const Study& study = read.value();
  REQUIRE(study.parameters.size() == parameter_kinds().size());
  CHECK(study.parameters[0].free);
  CHECK(study.parameters[0].scale == Scale::logarithmic);
  CHECK(study.parameters[5].value == 0.4);
  CHECK(study.parameters[7].value == parameter_kinds()[7].default_value);
  CHECK(study.search.budget_simulations == SearchOptions{}.budget_simulations);
  for (const Target& target : study.tests[0].targets) CHECK(target.weight == 1);
}

TEST_CASE("bounds in the wrong order, out of range or without logarithm are faults") {
  const Desk desk;
  const auto fault = [&](const char* name, const char* content) {
    json document = Desk::study();
    document["parameters"][name] = json::parse(content);
    const Faults faults = desk.faults(document);
    INFO(message_of(faults));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].where.find(std::string("parameters.") + name) != std::string::npos);
    return faults[0];
  };
  CHECK(says(fault("strength_pa", R"({"free": [60000, 200]})"), "not in order"));
  CHECK(says(fault("friction", R"({"free": [0.5, 0.5]})"), "not in order"));
  CHECK(says(fault("curvature", R"({"free": [-2, 1]})"), "must be -1 to 1"));
  CHECK(says(fault("formation_ratio", R"({"free": [0, 0.3], "scale": "log"})"), "no logarithm"));
  CHECK(says(fault("friction", R"({"value": 3})"), "must be 0 to 2"));
  CHECK(says(fault("friction", R"({"value": 0.3, "free": [0.1, 0.9]})"), "give one of them"));
  CHECK(says(fault("friction", R"({"value": 0.3, "scale": "log"})"), "no scale"));
  CHECK(says(fault("friction", R"({"free": [0.1]})"), "a list of 2 numbers"));
  CHECK(says(fault("friction", R"({"free": [0.1, 0.9], "scale": "linar"})"), "did you mean \"linear\"?"));
  CHECK(says(fault("frction", R"({"value": 0.3})"), "did you mean \"friction\"?"));
  CHECK(says(fault("friction", R"({})"), "is missing"));
}

TEST_CASE("a study with nothing to fit, or nothing to fit it to, is refused") {
  json document = Desk::study();
  document["parameters"] = {{"friction", {{"value", 0.4}}}};
  CHECK(says(at(Desk().faults(document), "parameters"), "none is free"));
  document = Desk::study();
  document["weights"] = {{"step1.height_mm", 0}, {"step1.spread_mm", 0}, {"step1.lateral_shift_mm", 0}};
  CHECK(says(at(Desk().faults(document), "weights"), "all are 0"));
}

TEST_CASE("a weight of what was not measured is a fault, and a slump's weight is the height's") {
  json document = Desk::study();
  document["weights"] = {{"step2.height_mm", 1}};
  CHECK(says(at(Desk().faults(document), "weights.step2.height_mm"), "no such measurement"));
  document["weights"] = {{"step1.slump_mm", 0.25}};
  const Result<Study> study = Desk().read(document);
  REQUIRE(study.ok());
  CHECK(study.value().tests[0].targets[0].reading == "step1.height_mm");
  CHECK(study.value().tests[0].targets[0].weight == 0.25);
}

TEST_CASE(
    "a reading's tolerance is its own, else tolerance_mm for a length and the laboratory's deviation for others") {
  const Desk desk;
  json lab = json::parse(template_text("lab").value(), nullptr, true, true);
  lab["measurements"]["step1.lateral_shift_mm"] = {{"value", 0}, {"standard_deviation", 20}};
  lab["measurements"]["fill.mass_kg"] = {{"value", 12.6}, {"standard_deviation", 0.3}};
  desk.folder().write("lab.json", lab.dump());
  json document = Desk::study();
  document["search"] = {{"tolerance_mm", 4}};
  const auto tolerances = [&] {
    const Result<Study> study = desk.read(document);
    INFO((study.ok() ? "" : message_of(study.faults())));
    REQUIRE(study.ok());
    std::map<std::string, double> out;
    for (const StudyReading& reading : readings_of(study.value())) out[reading.name] = reading.tolerance;
    return out;
  };
  using Tolerances = std::map<std::string, double>;
  CHECK(
      tolerances() ==
      Tolerances{{"fill.mass_kg", 0.3}, {"step1.height_mm", 4}, {"step1.lateral_shift_mm", 4}, {"step1.spread_mm", 4}});
  document["tolerances"] = {{"fill.mass_kg", 0.1}, {"step1.slump_mm", 2}};
  CHECK(
      tolerances() ==
      Tolerances{{"fill.mass_kg", 0.1}, {"step1.height_mm", 2}, {"step1.lateral_shift_mm", 4}, {"step1.spread_mm", 4}});
  document["tolerances"] = {{"step2.height_mm", 1}, {"step1.height_mm", 0}};
  CHECK(says(at(desk.faults(document), "tolerances.step2.height_mm"), "no such measurement"));
  CHECK(says(at(desk.faults(document), "tolerances.step1.height_mm"), "0"));
}

TEST_CASE("tolerances that nobody gives follow from the readings, the grains and the mould") {
  const Desk desk;
  json lab = json::parse(template_text("lab").value(), nullptr, true, true);
  lab["measurements"]["step1.lateral_shift_mm"] = {{"value", 0}, {"standard_deviation", 20}};
  lab["measurements"]["step1.spread_mm"]["standard_deviation"] = 1;  // finer than grains of 8 mm have a surface
  desk.folder().write("lab.json", lab.dump());
  const Result<Study> study = desk.read(Desk::study());
  REQUIRE(study.ok());
  std::map<std::string, double> tolerances;
  for (const StudyReading& reading : readings_of(study.value())) tolerances[reading.name] = reading.tolerance;
  CHECK(tolerances == std::map<std::string, double>{
                          {"step1.height_mm", 7.5}, {"step1.lateral_shift_mm", 40}, {"step1.spread_mm", 4}});
}

TEST_CASE("weights and tolerances of readings that were not taken are left out and told") {
  const Desk desk;
  json lab = json::parse(template_text("lab").value(), nullptr, true, true);
  lab["measurements"] = {{"step1.spread_mm", {{"value", 310}, {"standard_deviation", 25}}}};
  desk.folder().write("lab.json", lab.dump());
  json document = Desk::study();
  document["weights"] = {{"step1.slump_mm", 1}, {"step1.spread_mm", 2}};
  document["tolerances"] = {{"step1.slump_mm", 7.5}, {"step1.lateral_shift_mm", 40}};
  const Result<Study> study = desk.read(document);
  INFO((study.ok() ? "" : message_of(study.faults())));
  REQUIRE(study.ok());
  const StudyTest& test = study.value().tests[0];
  CHECK(test.not_measured == std::vector<std::string>{"step1.slump_mm", "step1.lateral_shift_mm"});
  REQUIRE(test.targets.size() == 1);
  CHECK(test.targets[0].weight == 2);
}

TEST_CASE("what is known of a parameter beforehand is read, and must agree with its bounds") {
  const Desk desk;
  json document = Desk::study();
  document["parameters"]["strength_pa"]["prior"] = {{"value", 2000}, {"standard_deviation", 500}};
  const Result<Study> read = desk.read(document);
  REQUIRE(read.ok());
  REQUIRE(read.value().parameters[0].prior);
  const UnitPrior prior = unit_prior(read.value().parameters[0]);
  CHECK(value_between(read.value().parameters[0], prior.mean) == Approx(2000));
  CHECK(value_between(read.value().parameters[0], prior.mean + prior.deviation) == Approx(2000 * std::exp(0.25)));
  const auto fault = [&](const char* name, const char* content) {
    json other = Desk::study();
    other["parameters"][name] = json::parse(content);
    const Faults faults = desk.faults(other);
    INFO(message_of(faults));
    REQUIRE(faults.size() == 1);
    return faults[0];
  };
  CHECK(says(fault("friction", R"({"value": 0.3, "prior": {"value": 0.3, "standard_deviation": 0.1}})"),
             "known already"));
  CHECK(says(fault("friction", R"({"free": [0.1, 0.5], "prior": {"value": 0.6, "standard_deviation": 0.1}})"),
             "contradicts the bounds"));
  CHECK(says(fault("friction", R"({"free": [0.1, 0.5], "prior": {"value": 0.3, "standard_deviation": 0}})"),
             "must be 4e-07 to 400000"));
  CHECK(says(fault("friction", R"({"free": [0.1, 0.5], "prior": {"value": 0.3}})"), "is missing"));
}

TEST_CASE("a prior or bounds that would leave residuals without digits are refused with their range") {
  const Desk desk;
  const auto refused = [&](const char* name, const char* content, const char* key, const char* what) {
    json document = Desk::study();
    document["parameters"][name] = json::parse(content);
    const Faults faults = desk.faults(document);
    INFO(content << "\n" << message_of(faults));
    REQUIRE(faults.size() == 1);
    CHECK(says(at(faults, "parameters." + std::string(name) + "." + key), what));
  };
  const char* prior = "prior.standard_deviation";
  const auto strength = [](const std::string& deviation) {
    return R"({"free": [100, 10000], "scale": "log", "prior": {"value": 1000, "standard_deviation": )" + deviation +
           "}}";
  };
  for (const char* deviation : {"1e-152", "1e-153", "5e-324", "1e-4", "1e12", "-1"})
    refused("strength_pa", strength(deviation).c_str(), prior, "must be 0.00460517 to 4.60517e+09");
  refused("friction", R"({"free": [1e-320, 1], "scale": "log"})", "free", "at least 1e-12");
  refused("friction", R"({"free": [0.3, 0.30000000000000004]})", "free", "the same within a millionth");
  refused("youngs_modulus_pa", R"({"free": [1e6, 1.0000001e6]})", "free", "the same within a millionth");
}

TEST_CASE("the inputs of a study change with what decides the search, not with its budget, title or mix") {
  const Desk desk;
  json document = Desk::study();
  const std::string first = inputs_of(desk.read(document).value());
  document["title"] = "another";
  document["search"] = {{"budget_simulations", 333}};
  CHECK(inputs_of(desk.read(document).value()) == first);
  CHECK(desk.read(document).value().search.end_early);
  document["search"]["end_early"] = false;
  CHECK_FALSE(desk.read(document).value().search.end_early);
  CHECK(inputs_of(desk.read(document).value()) != first);
  document["search"] = {{"seed", 2}};
  CHECK(inputs_of(desk.read(document).value()) != first);
  desk.folder().write("lab.json", test::with(template_text("lab").value(), "158", "159"));
  CHECK(inputs_of(desk.read(Desk::study()).value()) != first);
  const std::string lab = template_text("lab").value();
  desk.folder().write("lab.json", lab);
  const std::string without_mix = inputs_of(desk.read(Desk::study()).value());
  desk.folder().write("lab.json", test::with(lab, "\"material\":", "\"mix\": {\"water_kg_m3\": 180}, \"material\":"));
  CHECK(inputs_of(desk.read(Desk::study()).value()) == without_mix);
}

TEST_CASE("a budget that pays for no answer is a fault") {
  json document = Desk::study();
  document["search"] = {{"budget_simulations", 5}, {"packings", 2}, {"confirmation_packings", 4}};
  CHECK(says(at(Desk().faults(document), "search.budget_simulations"), "at least 6"));
  document["search"]["budget_simulations"] = 6.5;
  CHECK(says(at(Desk().faults(document), "search.budget_simulations"), "a whole number"));
}

TEST_CASE("where bridges form by touch no film is asked for") {
  json document = Desk::study();
  document["parameters"]["formation_ratio"] = {{"free", {0, 1}}};
  CHECK(Desk().read(document).ok());
  document["contact"] = {{"formation", "touch"}};
  CHECK(says(at(Desk().faults(document), "parameters.formation_ratio"), "chosen is formation \"touch\""));
}

TEST_CASE("a study of the time of the offset_ratio says what it is today") {
  json document = Desk::study();
  document["parameters"]["offset_ratio"] = {{"free", {0.1, 0.5}}};
  CHECK(says(at(Desk().faults(document), "parameters.offset_ratio"), "formation_ratio"));
}

TEST_CASE("the faults of study and laboratory file come together, each with its file") {
  const Desk desk;
  desk.folder().write("lab.json", test::with(template_text("lab").value(), "\"abrams\"", "\"abrans\""));
  json document = Desk::study();
  document["serch"] = json::object();
  const Faults faults = desk.faults(document);
  REQUIRE(faults.size() == 2);
  CHECK(says(at(faults, "study.json: serch"), "did you mean \"search\"?"));
  CHECK(says(at(faults, "lab.json: apparatus.preset"), "did you mean \"abrams\"?"));
}

TEST_CASE("a laboratory file that is not there is named with its path") {
  json document = Desk::study();
  document["lab"] = "nowhere.json";
  CHECK(says(at(Desk().faults(document), "nowhere.json"), "no such file"));
}

TEST_CASE("the hash of a study follows its content") {
  const Desk desk;
  json document = Desk::study();
  const std::string first = desk.read(document).value().hash;
  CHECK(desk.read(document).value().hash == first);
  document["title"] = "another";
  CHECK(desk.read(document).value().hash != first);
}

}  // namespace
}  // namespace pastefit
