#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/card/card.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/page.h"
#include "calibrate/report/page_content.h"
#include "calibrate/report/views.h"
#include "calibrate/store/program.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;

namespace {

std::string shipped_card() {
  return test::content(std::string(PASTEFIT_SOURCE_DIR) + "/data/cards/concrete-mix-79.json");
}

Findings findings_in(const test::Folder& folder) {
  auto found = read_findings(folder.path());
  REQUIRE(found.ok());
  return std::move(found).value();
}

}  // namespace

TEST_CASE("a page is made of a card alone, and says what it lacks") {
  const test::Folder folder;
  folder.write("card.json", shipped_card());
  const Findings findings = findings_in(folder);
  REQUIRE(findings.missing.size() == 1);
  CHECK_THAT(findings.missing[0], Catch::Contains("The simulations of the search are not shown"));
  const auto content = page_content(findings, "pastefit report somewhere");
  CHECK(content.at("verdict").at("meets_laboratory") == true);
  CHECK(content.at("tests")[0].at("readings").size() == findings.card->tests[0].readings.size());
  CHECK(content.at("search").at("history").empty());
}

TEST_CASE("a page tells what each packing read, and the error of a mean over several") {
  const test::Folder folder;
  folder.write("card.json", shipped_card());
  Findings findings = findings_in(folder);
  const std::string height = "step1.height_mm";
  const auto reading = [&] {
    const auto content = page_content(findings, "");
    const auto& readings = content.at("tests")[0].at("readings");
    return *std::ranges::find_if(readings, [&](const auto& one) { return one.at("name") == height; });
  };
  const CardTest& test = findings.card->tests[0];
  CHECK(reading().at("packings").size() == findings.card->confirmation.packings.size());
  CHECK(reading().at("packings")[1] == *test.baseline.runs[1].readings.find(height));
  CHECK(reading().at("standard_error") > 0);
  for (CardReading& one : findings.card->tests[0].readings) one.simulated.count = 1;
  CHECK_FALSE(reading().contains("standard_error"));
}

TEST_CASE("a page tells the lengths that the laboratory measured, also where nothing was simulated") {
  const test::Folder folder;
  folder.write("card.json", shipped_card());
  Findings findings = findings_in(folder);
  findings.views.clear();
  const auto search = page_content(findings, "").at("search");
  const auto& lengths = search.at("laboratory").at("");
  CHECK(lengths.size() >= 2);  // height and spread
  for (const auto& length : lengths) {
    CHECK(length.at("by") == "laboratory");
    CHECK(length.at("value") == search.at("measured").at(length.at("reading").get<std::string>()));
  }
}

TEST_CASE("a folder that is none, or has no result in it, has no page") {
  const test::Folder folder;
  CHECK_FALSE(read_findings(folder.path() / "none").ok());
  const auto empty = read_findings(folder.path());
  REQUIRE_FALSE(empty.ok());
  CHECK_THAT(empty.faults()[0].what, Catch::Contains("holds neither card.json nor evaluations.sqlite"));
}

TEST_CASE("a damaged card and a damaged store are missing in the findings, which are there all the same") {
  const test::Folder folder;
  folder.write("card.json", shipped_card().substr(0, 2000));
  folder.write("evaluations.sqlite", "not a database");
  const Findings findings = findings_in(folder);
  CHECK_FALSE(findings.card);
  REQUIRE(findings.missing.size() == 2);
  CHECK_THAT(findings.missing[0], Catch::Contains("The card cannot be read"));
}

TEST_CASE("texts of others stay texts in a page") {
  const test::Folder folder;
  auto card = nlohmann::ordered_json::parse(shipped_card());
  card["title"] = "</script><script>alert(1)</script><!--";
  card["tests"][0]["lab"]["notes"] = "<img src=x onerror=alert(2)>";
  folder.write("card.json", card.dump());
  const std::string page = page_of(findings_in(folder), "pastefit report '<b>'");
  CHECK_THAT(page, !Catch::Contains("<script>alert") && !Catch::Contains("<img") && !Catch::Contains("'<b>'"));
  const std::string begin = "id=\"content\">";
  const auto from = page.find(begin) + begin.size();
  const auto content = nlohmann::ordered_json::parse(page.substr(from, page.find("</script>", from) - from));
  CHECK(content.at("title") == card["title"]);
  CHECK(content.at("tests")[0].at("notes") == card["tests"][0]["lab"]["notes"]);
}

TEST_CASE("a page asks nothing of a network") {
  const test::Folder folder;
  folder.write("card.json", shipped_card());
  const std::string page = page_of(findings_in(folder), "");
  CHECK_THAT(page, Catch::Contains("content=\"default-src 'none'; script-src 'unsafe-inline'; style-src "
                                   "'unsafe-inline'; img-src data:\""));
  CHECK_THAT(page, !Catch::Contains("<link") && !Catch::Contains(" src=\""));
}

TEST_CASE("the other attractions of a drawn law have its force at touch and its reach") {
  const test::Folder folder;
  folder.write("card.json", shipped_card());
  const Card card = *findings_in(folder).card;
  const auto curves = law_curves(card, {});
  REQUIRE(curves.size() == 4);  // fitted and three others
  for (const auto& curve : curves) {
    double at_touch = 0, farthest = 0;
    for (const auto& point : curve.at("points")) {
      if (point[0] == 0) at_touch = point[1];
      if (point[1] != 0) farthest = std::min(farthest, point[0].get<double>());
    }
    INFO(curve.at("name"));
    CHECK(at_touch == Approx(-1e3 * card.material.contact.bridge.c_n).epsilon(1e-4));
    CHECK(farthest >= 1e6 * card.material.contact.bridge.d_c_m * (1 + 1e-4));
  }
  CHECK(curves.back().at("role") == "fitted");
}

TEST_CASE("a look at a test has its film, and the readings and outlines of every packing") {
  CardTest of_card;
  SlumpTest test;
  test.grains.radius_m = 0.014;
  of_card.test = test;
  const std::vector<std::uint64_t> packings{5, 6};
  const TestView view = view_of(of_card, packings, 2, [] { return true; });
  REQUIRE(view.runs.size() == 2);
  test.packing_seed = 6;
  CHECK(view.runs[1].readings.find("step1.height_mm") == simulate(test).readings.find("step1.height_mm"));
  CHECK(view.runs[0].outlines.contains("step1"));
  CHECK(view.lacking == 0);
  CHECK(view.program == program_identity());
  CHECK_FALSE(view.film.empty());
  const auto drawings = drawings_of(of_card.test, view.runs, {});
  REQUIRE(drawings.size() == 1);
  // So few grains may shear off.
  CHECK(std::ranges::count(drawings[0].lines, DrawnBy::run, &DrawnLine::by) +
            std::ranges::count(drawings[0].lines, DrawnBy::rejected, &DrawnLine::by) ==
        2);
  const TestView stopped = view_of(of_card, packings, 1, [] { return false; });
  CHECK(stopped.runs.empty());
  CHECK(stopped.failures.empty());
  CHECK(stopped.lacking == 2);
}
