#include <catch2/catch.hpp>

#include "calibrate/report/run_recording.h"
#include "calibrate/report/views.h"

namespace pastefit {
namespace {

/// Simulated as a search does it: on a packing that was prepared before, with somebody looking on.
Outcome simulated(const Test& test, RunRecordings& looks) {
  const RunObserver::Watch watch = looks.begin(test);
  RunOptions options;
  options.watch_interval_s = looks.interval_s();
  options.watch = [&](const Snapshot& snapshot) {
    watch(snapshot);
    return true;
  };
  options.packing = prepare(test, options);
  Outcome outcome = simulate(test, options);
  looks.end(test, outcome);
  return outcome;
}

TEST_CASE("what was seen during a search is shown without simulating it again") {
  CardTest of_card;
  of_card.test = SlumpTest{};
  Specimen& specimen = specimen_of(of_card.test);
  specimen.grains.radius_m = 0.014;
  const std::vector<std::uint64_t> packings{5, 6};
  RunRecordings looks;
  std::vector<Outcome> outcomes;
  for (const std::uint64_t packing : packings) {
    specimen.packing_seed = packing;
    outcomes.push_back(simulated(of_card.test, looks));
  }
  int asked = 0;
  const auto goes_on = [&] { return ++asked < 0; };  // whatever is simulated ends at once
  const TestView view = view_of(of_card, packings, 1, goes_on, &looks);
  CHECK(asked == 0);
  CHECK(view.failures.empty());
  REQUIRE(view.runs.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(view.runs[i].packing == packings[i]);
    CHECK(view.runs[i].readings.find("step1.height_mm") == outcomes[i].readings.find("step1.height_mm"));
    CHECK(view.runs[i].outlines.contains("step1"));
  }

  // The film is the one that a simulation for its own sake gives.
  const TestView anew = view_of(of_card, {packings.data(), 1}, 1, [] { return true; });
  CHECK(view.film == anew.film);
}

TEST_CASE("a simulation that was not seen to its end counts as not seen") {
  RunRecordings looks;
  const Test test = SlumpTest{};
  (void)looks.begin(test);
  CHECK_FALSE(looks.take(test));
}

}  // namespace
}  // namespace pastefit
