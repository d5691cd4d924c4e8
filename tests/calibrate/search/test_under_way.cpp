#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "calibrate/card/calibration_card.h"
#include "calibrate/search/search.h"
#include "core/random.h"
#include "tests/calibrate/search/laboratory.h"

using namespace pastefit;
using namespace pastefit::test;

namespace {

void begin(Objective& objective, const UnitPoint& point) {
  objective.begin({&point, 1}, kPackings, true);
}

}  // namespace

TEST_CASE("what is begun runs while nobody waits, several candidates at once, each simulation a single time") {
  Laboratory laboratory;
  auto store = laboratory.store();
  std::atomic<bool> released = false, in_time = true;
  laboratory.options.threads = 6;
  laboratory.twist = [&](auto&&...) {  // on many threads, which Catch2's checks are not for
    if (!comes_true([&] { return released.load(); })) in_time = false;
  };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  const std::vector<UnitPoint> points{at(0.1, 0.5), at(0.2, 0.5), at(0.3, 0.5)};
  for (const auto& point : points) begin(objective, point);
  begin(objective, points[0]);
  CHECK(comes_true([&] { return laboratory.runs == 6; }));
  CHECK(objective.budget_left() == 20);  // nobody has asked yet
  released = true;
  CHECK(objective.try_out(points, kPackings).size() == 3);
  CHECK(objective.budget_left() == 14);
  CHECK(laboratory.runs == 6);
  CHECK(objective.counts().simulated == 6);
  CHECK(in_time);
}

TEST_CASE("simulations start in the order in which they were begun") {
  Laboratory laboratory;
  auto store = laboratory.store();
  std::vector<double> order;
  laboratory.options.threads = 1;
  laboratory.twist = [&](const SlumpTest& test, auto&&...) { order.push_back(test.contact.friction); };
  SimulationObjective objective(laboratory.study, store, laboratory.options);
  for (const double friction : {0.5, 0.2, 0.9, 0.1}) begin(objective, at(0.5, friction));
  (void)objective.try_out(std::vector<UnitPoint>{at(0.5, 0.1)}, kPackings);
  CHECK(order == std::vector<double>{0.5, 0.5, 0.2, 0.2, 0.9, 0.9, 0.1, 0.1});
}

TEST_CASE("an objective that goes away ends what is under way and stores none of it") {
  Laboratory laboratory;
  auto store = laboratory.store();
  std::atomic<bool> in_time = true;
  laboratory.options.threads = 2;
  laboratory.twist = [&](const SlumpTest&, const RunOptions& run, Outcome& outcome) {
    if (!comes_true([&] { return !run.watch({}); })) in_time = false;
    fail(outcome, FailureReason::stopped, 0.1);
  };
  {
    SimulationObjective objective(laboratory.study, store, laboratory.options);
    for (const double friction : {0.1, 0.2, 0.3}) begin(objective, at(0.5, friction));
    CHECK(comes_true([&] { return laboratory.runs == 2; }));
  }
  CHECK(in_time);
  CHECK(laboratory.runs == 2);
  CHECK(store.size() == 0);
}

TEST_CASE("the same study gives the same history and card, whatever the threads, the candidates pending and the delays",
          "[campaign]") {
  for (const int max_pending : {0, 1, 3}) {
    std::string card_of_one_thread;
    std::vector<UnitPoint> way_of_one_thread;
    for (const int threads : {1, 2, 8}) {
      CAPTURE(max_pending, threads);
      Laboratory laboratory;
      auto& study = laboratory.study;
      study.search.max_pending = max_pending;
      study.search.budget_simulations = 60;
      study.search.tolerance_mm = 0.2;  // never met: the whole budget is spent
      laboratory.options.threads = threads;
      std::atomic<int> delays = 0;
      laboratory.twist = [&](const SlumpTest& test, const RunOptions&, Outcome& outcome) {
        const RandomStream random(test.packing_seed, "luck"), delay(static_cast<std::uint64_t>(threads), "delay");
        const double friction = test.contact.friction, c_n = test.contact.bridge.c_n;
        const auto digits = static_cast<std::uint64_t>(1e12 * (friction + c_n));
        outcome.readings.set("step1.height_mm",
                             100 + 50 * (friction - 0.5) + 15 * std::sin(3 * std::log(c_n)) + random.normal(digits));
        std::this_thread::sleep_for(
            std::chrono::microseconds(static_cast<int>(4000 * delay.uniform(static_cast<std::uint64_t>(delays++)))));
      };
      auto store = laboratory.store();
      SimulationObjective objective(study, store, laboratory.options);
      const Calibration calibration = search(objective, study.search);
      CHECK(calibration.simulations > 40);
      const std::string card = to_json(card_of(study, calibration, store, objective.counts(), "study.json")).dump();
      std::vector<UnitPoint> way;
      for (const Response& response : calibration.history) way.push_back(response.point);
      if (threads == 1) {
        card_of_one_thread = card;
        way_of_one_thread = way;
      }
      CHECK(card == card_of_one_thread);
      CHECK(way == way_of_one_thread);
    }
  }
}
