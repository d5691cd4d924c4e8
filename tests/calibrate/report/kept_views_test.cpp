#include <catch2/catch.hpp>

#include "calibrate/report/views.h"
#include "tests/calibrate/folder.h"

namespace pastefit {
namespace {

Card card_of(double friction) {
  Card card;
  card.tests.emplace_back();
  card.tests[0].test = SlumpTest{};
  specimen_of(card.tests[0].test).contact.friction = friction;
  return card;
}

TestView view_of_two() {
  TestView view;
  view.program = "some program";
  view.film = {R"({"low_m":[0.0,0.1,0.2],"quantum_m":5e-05})", "QUJD"};
  SeenRun run;
  run.packing = 18446744073709551615u;
  run.readings.set("step1.height_mm", 1.0 / 3);
  run.outlines["step1"] = {-0.1, 0.002, {0, 1.0 / 7, 0}};
  run.curve = Curve{"crush", "strain", "stress [Pa]", {{0, 1}, {0.5, 1e5 / 3}}};
  view.runs = {run, SeenRun{6, {}, {}, {}}};
  view.failures = {"packing 7: lost a grain"};
  return view;
}

const std::vector<std::uint64_t> kPackings{18446744073709551615u, 6, 7};

TEST_CASE("kept views are read as they were written, to the last bit") {
  const test::Folder folder;
  const auto file = folder.path() / kViewsFile;
  const TestView view = view_of_two();
  REQUIRE(write_views(file, card_of(0.5), kPackings, {view}).empty());
  const auto read = read_views(file, card_of(0.5), kPackings);
  REQUIRE(read.ok());
  REQUIRE(read.value().size() == 1);
  const TestView& same = read.value()[0];
  CHECK(same.program == view.program);
  CHECK(same.film == view.film);
  CHECK(same.failures == view.failures);
  REQUIRE(same.runs.size() == 2);
  CHECK(same.runs[0].packing == view.runs[0].packing);
  CHECK(same.runs[0].readings.find("step1.height_mm") == 1.0 / 3);
  CHECK(same.runs[0].outlines.at("step1").height_m == view.runs[0].outlines.at("step1").height_m);
  CHECK(same.runs[0].curve->points[1].y == 1e5 / 3);
  CHECK_FALSE(same.runs[1].curve);
}

TEST_CASE("views of another material or of other packings are refused") {
  const test::Folder folder;
  const auto file = folder.path() / kViewsFile;
  REQUIRE(write_views(file, card_of(0.5), kPackings, {view_of_two()}).empty());
  const auto other = read_views(file, card_of(0.25), kPackings);
  REQUIRE_FALSE(other.ok());
  CHECK_THAT(other.faults()[0].what, Catch::Contains("is of another material"));
  CHECK_FALSE(read_views(file, card_of(0.5), std::vector<std::uint64_t>{6, 7}).ok());
}

TEST_CASE("views that are damaged, missing or made to harm are refused") {
  const test::Folder folder;
  const Card card = card_of(0.5);
  CHECK_FALSE(read_views(folder.path() / "none", card, kPackings).ok());
  const auto file = folder.path() / kViewsFile;
  REQUIRE(write_views(file, card, kPackings, {view_of_two()}).empty());
  std::string text = test::content(file);
  for (const std::size_t length : {text.size() / 2, std::size_t{0}})
    CHECK_FALSE(read_views(folder.write("cut", text.substr(0, length)), card, kPackings).ok());
  std::string flipped = text;
  flipped.replace(flipped.find("QUJD"), 4, "QUJE");
  const auto damaged = read_views(folder.write("flipped", flipped), card, kPackings);
  REQUIRE_FALSE(damaged.ok());
  CHECK_THAT(damaged.faults()[0].what, Catch::Contains("is damaged"));

  TestView view = view_of_two();
  view.film.grains = "</script><script>alert(1)</script>";
  REQUIRE(write_views(file, card, kPackings, {view}).empty());
  const auto harmful = read_views(file, card, kPackings);
  REQUIRE_FALSE(harmful.ok());
  CHECK_THAT(harmful.faults()[0].what, Catch::Contains("base64"));
  view = view_of_two();
  view.runs[0].outlines["step1"].first_x_m = -1e9;
  REQUIRE(write_views(file, card, kPackings, {view}).empty());
  CHECK_FALSE(read_views(file, card, kPackings).ok());
}

}  // namespace
}  // namespace pastefit
