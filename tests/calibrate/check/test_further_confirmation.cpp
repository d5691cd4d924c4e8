#include <catch2/catch.hpp>
#include <cmath>

#include "calibrate/check/check.h"

using namespace pastefit;

namespace {

/// A card with one reading of 100 +- 3 mm over 9 packings, measured 101 mm within 5 mm.
Card card_of_height() {
  Card card;
  card.tests.emplace_back().test = SlumpTest{};
  CardReading height;
  height.name = "step1.height_axis_mm";
  height.simulated = {9, 100, 3};
  height.measured = 101;
  height.weight = 1;
  height.tolerance = 5;
  card.tests[0].readings = {height};
  return card;
}

/// Heaps that hardly shifted, but for the first ones, which sheared off.
std::vector<Baseline::Run> runs_of_heights(const std::vector<double>& heights, std::size_t sheared = 0) {
  std::vector<Baseline::Run> runs;
  for (const double height : heights) {
    Readings readings;
    readings.set("step1.height_axis_mm", height);
    readings.set("step1.lateral_shift_mm", runs.size() < sheared ? 90 : 5 + static_cast<double>(runs.size() % 3));
    readings.set("step1.unknown_mm", 1);
    runs.push_back({runs.size() + 1, readings});
  }
  return runs;
}

/// The confirmation of the first test by these runs.
FurtherConfirmation confirmed_by(const Card& card, const std::vector<Baseline::Run>& runs) {
  FurtherConfirmation done;
  done.engine = "lammps";
  done.ranks = 2;
  done.core_s = 20;
  return further_confirmation(card, card.tests[0], card.tests[0].test, runs, done);
}

}  // namespace

TEST_CASE("the bias of another engine is the difference of the means, with the noise of both") {
  const Card card = card_of_height();
  const auto there = confirmed_by(card, runs_of_heights({102, 104, 106, 108}));
  REQUIRE(there.readings.size() == 1);
  CHECK(there.readings[0].bias() == 5);
  const double variance = 20.0 / 3;  // of 102, 104, 106, 108
  CHECK(*there.readings[0].standard_error == Approx(std::sqrt(variance / 4 + 9.0 / 9)));
  CHECK(*there.error == Approx(4.0 / 5));
  CHECK(there.packings == std::vector<std::uint64_t>{1, 2, 3, 4});
  CHECK(there.engine == "lammps");
  CHECK(there.ranks == 2);
  CHECK(there.core_s == 20);
  CHECK(there.meets_laboratory);
}

TEST_CASE("a material meets the laboratory in another engine only where its readings and their noise allow it") {
  Card card = card_of_height();
  const auto verdict = [&](const std::vector<double>& heights) {
    return confirmed_by(card, runs_of_heights(heights)).meets_laboratory;
  };
  CHECK(verdict({101, 101.5, 101, 101.5}));
  CHECK_FALSE(verdict({107, 107.5, 107, 107.5}));  // 1.25 tolerances off
  CHECK_FALSE(verdict({90, 112, 90, 112}));        // right in the mean, by chance
  card.interpolated.emplace();
  CHECK_FALSE(verdict({101, 101.5, 101, 101.5}));
}

TEST_CASE("a material half of whose heaps shear off in another engine does not meet the laboratory there") {
  const Card card = card_of_height();
  const auto meets = [&](std::size_t sheared) {
    const auto runs = runs_of_heights({101, 101.5, 101, 101.5, 101, 101.5, 101, 101.5}, sheared);
    const auto there = confirmed_by(card, runs);
    CHECK(*there.error < 1);
    return there.meets_laboratory;
  };
  CHECK(meets(0));
  CHECK_FALSE(meets(4));
  CHECK_FALSE(meets(7));  // of the one that is left the scatter is not known
}

TEST_CASE("the bias against one packing has no standard error, and a test that is held out has no verdict") {
  Card card = card_of_height();
  card.tests[0].readings[0].simulated.count = 1;
  card.tests[0].hold_out = true;
  const auto there = confirmed_by(card, runs_of_heights({101, 102}));
  CHECK_FALSE(there.readings[0].standard_error.has_value());
  CHECK_FALSE(there.error.has_value());
  CHECK_FALSE(there.meets_laboratory);
}
