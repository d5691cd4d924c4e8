#pragma once

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "calibrate/study/parameters.h"
#include "core/apparatus/slump/packing.h"
#include "tests/calibrate/folder.h"
#include "tests/calibrate/search/simulation_objective.h"
#include "tests/calibrate/slump.h"

namespace pastefit::test {

/// A study of two free parameters and three readings, of which the spread is not fitted, with an engine that answers
/// at once: height = 100 mm + 1 mm per packing seed + 50 mm (friction - 0.5).
struct Laboratory {
  const test::Folder folder;
  Study study;
  std::atomic<int> fills = 0;
  std::atomic<int> runs = 0;
  std::function<void(const SlumpTest&, const RunOptions&, Outcome&)> twist = [](auto&&...) {};
  PoolOptions options;

  Laboratory() {
    for (const auto& kind : parameter_kinds())
      study.parameters.push_back({std::string(kind.name), false, kind.default_value, 0, 0, kind.scale});
    for (auto& parameter : study.parameters) {
      if (parameter.name == "strength_pa") parameter = {"strength_pa", true, 0, 100, 10000, Scale::logarithmic};
      if (parameter.name == "friction") parameter = {"friction", true, 0, 0, 1, Scale::linear};
    }
    study.tests.emplace_back();
    study.tests[0].lab.test = with_default_contact(SlumpTest{});
    study.tests[0].lab.measurements = {
        {"step1.height_mm", 100, 2, 3}, {"step1.spread_mm", 400, 10, 1}, {"fill.mass_kg", 9, 0.1, 1}};
    study.tests[0].targets = {{"step1.height_mm", 4}, {"step1.spread_mm", 0}, {"fill.mass_kg", 1}};
    study.search.budget_simulations = 20;
    study.search.tolerance_mm = 5;
    options.threads = 4;
    options.engine.prepare = [this](const Test&, const RunOptions&) {
      ++fills;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return std::make_shared<const Packing>();
    };
    options.engine.run = of_slump([this](const SlumpTest& test, const RunOptions& run) {
      ++runs;
      Outcome outcome;
      outcome.readings.set("step1.height_mm",
                           100.0 + static_cast<double>(test.packing_seed) + 50 * (test.contact.friction - 0.5));
      outcome.readings.set("step1.spread_mm", 350);
      outcome.readings.set("fill.mass_kg", 9.1);
      outcome.run.simulated_s = 2;
      twist(test, run, outcome);
      return outcome;
    });
  }

  Store store() const {
    auto opened = Store::open(folder.path() / "evaluations.sqlite", {"program", "inputs"});
    REQUIRE(opened.ok());
    return std::move(opened).value();
  }
};

/// Waits for a condition; false if that takes too long.
inline bool comes_true(const std::function<bool()>& condition) {
  const auto start = std::chrono::steady_clock::now();
  while (!condition()) {
    if (std::chrono::steady_clock::now() - start > std::chrono::seconds(20)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

inline UnitPoint at(double strength, double friction) {
  return Eigen::Vector2d(strength, friction);
}

inline Outcome& fail(Outcome& outcome, FailureReason reason, double time_s) {
  outcome.readings = {};
  outcome.failure = Failure{reason, "step1.lift", 1, time_s, -1, 0, 0, "no good"};
  return outcome;
}

inline const std::vector<std::uint64_t> kPackings{1, 3};

}  // namespace pastefit::test
