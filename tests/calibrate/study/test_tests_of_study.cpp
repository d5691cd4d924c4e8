#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "tests/calibrate/files.h"
#include "tests/calibrate/study/desk.h"

namespace pastefit {
namespace {

using nlohmann::json;
using test::at;
using test::Desk;
using test::says;

TEST_CASE("a material may shear off as often as the laboratory's did, unless the study says how often") {
  const auto share = [](int made, int sheared, const char* search) {
    const Desk desk;
    json lab = json::parse(template_text("lab").value(), nullptr, true, true);
    lab["measurements"].erase("step1.slump_mm");
    lab["repeats"] = {{"made", made}, {"sheared", sheared}};
    desk.folder().write("lab.json", lab.dump());
    json study = json::parse(template_text("study").value(), nullptr, true, true);
    study["search"] = json::parse(search);
    return read_study(desk.folder().write("study.json", study.dump())).value().search.rejected_share;
  };
  CHECK(share(4, 0, "{}") == 0.2);
  CHECK(share(10, 1, "{}") == 0.2);
  CHECK(share(3, 1, "{}") == Approx(1.0 / 3));
  CHECK(share(3, 1, R"({"rejected_share": 0.1})") == 0.1);
}

TEST_CASE("a study may name several laboratory files, fitted ones first, hold-outs kept apart") {
  const Desk desk;
  desk.folder().write("mini.json", test::with(template_text("lab").value(), "\"abrams\"", "\"abrams-en\""));
  json document = Desk::study();
  document.erase("lab");
  document["contact"] = {{"friction_basis", "elastic"}};
  document["tests"] = json::parse(R"([
    {"name": "later", "lab": "mini.json", "hold_out": true},
    {"name": "cone", "lab": "lab.json", "weights": {"step1.spread_mm": 0}},
    {"name": "other", "lab": "mini.json"}])");
  const Result<Study> read = desk.read(document);
  INFO((read.ok() ? "" : message_of(read.faults())));
  REQUIRE(read.ok());
  const Study& study = read.value();
  REQUIRE(study.tests.size() == 3);
  CHECK(study.tests[0].name == "cone");
  CHECK(study.tests[2].hold_out);
  for (const StudyTest& test : study.tests)
    CHECK(specimen_of(test.lab.test).contact.friction_basis == FrictionBasis::elastic);
  const auto readings = readings_of(study);
  REQUIRE(readings.size() == 5);
  CHECK(readings[0].name == "cone/step1.height_mm");
  CHECK(readings[2].name == "cone/step1.spread_mm");
  CHECK(readings[2].weight == 0);
  CHECK(readings[4].name == "other/step1.spread_mm");
  CHECK(readings[4].weight == 1);
  CHECK(tests_of(study, true) == std::vector<std::size_t>{2});
}

TEST_CASE("a study of one test says the same in either form") {
  const Desk desk;
  json document = Desk::study();
  const Study before = desk.read(document).value();
  document.erase("lab");
  document["tests"] = {{{"name", "only"}, {"lab", "lab.json"}}};
  const Study after = desk.read(document).value();
  CHECK(before.tests[0].lab.content == after.tests[0].lab.content);
  CHECK(readings_of(before)[0].name == "step1.height_mm");
  CHECK(readings_of(after)[0].name == "only/step1.height_mm");
}

TEST_CASE("what is wrong with a list of tests is said with its place, all at once") {
  const Desk desk;
  json document = Desk::study();
  document["weights"] = {{"step1.height_mm", 1}};
  document["tests"] = json::parse(R"([
    {"name": "a/b", "lab": "lab.json"},
    {"name": "twice", "lab": "lab.json", "weights": {"step2.height_mm": 1}},
    {"name": "twice", "lab": "nowhere.json"},
    {"lab": "lab.json", "holdout": true},
    7])");
  const Faults faults = desk.faults(document);
  INFO(message_of(faults));
  CHECK(says(at(faults, "json: lab"), "beside"));
  CHECK(says(at(faults, "json: weights"), "beside"));
  CHECK(says(at(faults, "tests[0].name"), "letters"));
  CHECK(says(at(faults, "tests[1].weights.step2.height_mm"), "no such measurement"));
  CHECK(says(at(faults, "tests[2].name"), "two tests"));
  CHECK(says(at(faults, "nowhere.json"), "no such file"));
  CHECK(says(at(faults, "tests[3].name"), "missing"));
  CHECK(says(at(faults, "tests[3].holdout"), "hold_out"));
  CHECK(says(at(faults, "tests[4]"), "not an object"));
  CHECK(faults.size() == 9);
}

TEST_CASE("a study of hold-outs alone has nothing to fit") {
  json document = Desk::study();
  document.erase("lab");
  document["tests"] = {{{"name", "a"}, {"lab", "lab.json"}, {"hold_out", true}}};
  CHECK(says(at(Desk().faults(document), "tests"), "all are held out"));
  document["tests"] = json::array();
  CHECK(says(at(Desk().faults(document), "tests"), "not a list of 1 to 20"));
}

}  // namespace
}  // namespace pastefit
