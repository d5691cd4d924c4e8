#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/laboratory/test.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/slump_sheet.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {
namespace {

using nlohmann::json;

Sheet tilted_sheet() {
  Sheet sheet;
  sheet.mould = "200/200/50";
  sheet.density = "2300";
  sheet.target = "lammps";
  sheet.readings = {{"height", "48"}, {"slide-angle", "25, 26, 24"}};
  return sheet;
}

json without_comments(const std::string& text) {
  return json::parse(text, nullptr, true, true);
}

}  // namespace

TEST_CASE("a sheet with an angle of sliding searches the table's friction, and its base does not roll") {
  const auto files = starting_files(tilted_sheet(), ".");
  REQUIRE(files.ok());
  const json lab = without_comments(files.value().lab), study = without_comments(files.value().study);
  CHECK(lab["measurements"]["tilt.slide_angle_deg"]["repeats"] == json{25, 26, 24});
  CHECK(study["parameters"]["table_friction"].contains("free"));
  CHECK(study["parameters"]["table_rolling_friction"]["value"] == 0.5);
  CHECK_FALSE(study["parameters"].contains("table_cohesion_factor"));  // as a heap that stands on its own would have
}

TEST_CASE("a card's test keeps its tilt, and a test without one says nothing of it") {
  SlumpTest tilted;
  tilted.tilt = Tilt{2, 0.003};
  const auto again = test_from_json(to_json(Test(tilted)));
  REQUIRE(again.ok());
  const SlumpTest& read = std::get<SlumpTest>(again.value());
  REQUIRE(read.tilt);
  CHECK(read.tilt->rate_deg_s == 2);
  CHECK(read.tilt->slide_m == 0.003);
  CHECK_FALSE(to_json(Test(SlumpTest{})).contains("tilt"));
}

TEST_CASE("an angle of sliding after a drop is refused with what to do") {
  Sheet sheet = tilted_sheet();
  sheet.mould = "hinged-plate";
  sheet.readings = {{"height", "120"}, {"height2", "100"}, {"slide-angle", "25"}};
  const auto files = starting_files(sheet, ".");
  REQUIRE_FALSE(files.ok());
  CHECK(files.faults()[0].remedy.find("two tests") != std::string::npos);
}

}  // namespace pastefit
