#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "calibrate/store/outcome_json.h"
#include "tests/calibrate/folder.h"
#include "tests/calibrate/store/stored.h"

using namespace pastefit;
using namespace pastefit::test;

namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

TEST_CASE("the store returns every bit of an evaluation after it was opened again") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  auto kept = evaluation(0.3);
  kept.point = {-0.0, 5e-324, 0.1, 1 - 0x1p-53};
  kept.packing = std::numeric_limits<std::uint64_t>::max();
  kept.sketch = {true, {{-100, 0}, {0.1, 12.5}}};
  CHECK(opened(file).add(kept).empty());

  const auto found = opened(file).find(kept.key);
  REQUIRE(found);
  REQUIRE(found->point.size() == kept.point.size());
  for (std::size_t i = 0; i < kept.point.size(); ++i) CHECK(same_bits(found->point[i], kept.point[i]));
  for (std::size_t i = 0; i < kept.values.size(); ++i) CHECK(same_bits(found->values[i], kept.values[i]));
  CHECK(found->packing == kept.packing);
  REQUIRE(found->readings.all().size() == 2);
  CHECK(found->readings.all()[0].name == "step1.height_mm");
  CHECK(same_bits(found->readings.all()[0].value, kept.readings.all()[0].value));
  CHECK(same_bits(found->readings.all()[1].value, kept.readings.all()[1].value));
  CHECK_FALSE(found->failure);
  CHECK(found->run.particle_steps == kept.run.particle_steps);
  CHECK(same_bits(found->run.time_step_s, kept.run.time_step_s));
  CHECK(same_bits(found->wall_s, kept.wall_s));
  CHECK(same_bits(found->core_s, kept.core_s));
  CHECK(found->sketch.heap);
  CHECK(found->sketch.points == kept.sketch.points);
}

TEST_CASE("parameters are kept by name, those that are not default, and one that is absent has its default value") {
  auto values = default_values();
  values[0] = 1234.5;
  values[5] = 1.0 / 3;
  const nlohmann::json kept = parameters_to_json(values);
  CHECK(kept == nlohmann::json{{"friction", 1.0 / 3}, {"strength_pa", 1234.5}});
  CHECK(parameters_from_json(kept) == values);
  CHECK(parameters_from_json(nlohmann::json::object()) == default_values());
  CHECK_THROWS_AS(parameters_from_json({{"stickiness", 1}}), std::invalid_argument);
}

TEST_CASE("a field that is added with its default value leaves the name of an evaluation as it was") {
  SlumpTest test;
  test.contact.friction = 0.15;
  test.drop.emplace().mass_kg = 12;
  const auto by_default = default_test(test);
  CHECK(identity_of(test)[0] == "slump");
  const auto before = differing_part(to_json(test), to_json(by_default));
  CHECK(identity_of(test)[1] == before);
  CHECK(before == nlohmann::json{{"contact", {{"friction", 0.15}}}, {"drop", {{"mass_kg", 12.0}}}});
  auto larger_test = to_json(test), larger_default = to_json(by_default);
  for (auto* one : {&larger_test, &larger_default}) {
    (*one)["contact"]["throwaway"] = 0.7;
    (*one)["drop"]["bounces"] = nullptr;
    (*one)["reading"]["outline_step3_m"] = nlohmann::json::array();
  }
  CHECK(differing_part(larger_test, larger_default) == before);
  larger_test["contact"]["throwaway"] = 0.8;
  CHECK(differing_part(larger_test, larger_default) != before);
  // What tells tests apart tells their names apart.
  const auto key = [](const SlumpTest& one) { return evaluation_key("program", one); };
  SlumpTest without = test, outlined = test;
  without.drop.reset();
  outlined.reading.outline_step1 = {{-0.1, 0}, {0.1, 0}};
  SlumpTest usual_plate = test;
  usual_plate.drop = DropPlate{};
  CHECK(std::set{key(test), key(without), key(outlined), key(usual_plate)}.size() == 4);
}

TEST_CASE("a failure keeps its reason and its values, finite or not") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  auto kept = evaluation(0.3);
  kept.readings = {};
  kept.failure = Failure{FailureReason::excessive_overlap,
                         "step1.lift",
                         1234,
                         0.5,
                         17,
                         std::numeric_limits<double>::infinity(),
                         0.3,
                         "Grain 17 \"sinks\"; use stiffer grains."};
  CHECK(opened(file).add(kept).empty());
  const auto found = opened(file).find(kept.key);
  REQUIRE(found);
  REQUIRE(found->failure);
  CHECK(found->failure->reason == FailureReason::excessive_overlap);
  CHECK(found->failure->phase == "step1.lift");
  CHECK(found->failure->step == 1234);
  CHECK(found->failure->grain == 17);
  CHECK(std::isinf(found->failure->value));
  CHECK(found->failure->message == kept.failure->message);
  CHECK(found->readings.all().empty());
}

TEST_CASE("an evaluation that was added survives kill -9") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    auto store = Store::open(file, kIdentity);
    for (int i = 0; i < 5; ++i) (void)store.value().add(evaluation(0.1 * i));
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  const auto store = opened(file);
  CHECK(store.size() == 5);
  CHECK(store.find(evaluation(0.4).key));
  CHECK(store.all()[2].point[0] == 0.2);
}

TEST_CASE("an evaluation is kept once and found by its key only") {
  const Folder folder;
  auto store = opened(folder.path() / "evaluations.sqlite");
  CHECK(store.add(evaluation(0.5)).empty());
  CHECK(store.add(evaluation(0.5)).empty());
  CHECK(store.size() == 1);
  CHECK_FALSE(store.find(evaluation(0.5, 8).key));
  CHECK_FALSE(store.find(evaluation(std::nextafter(0.5, 1)).key));
}

TEST_CASE("the key tells tests and programs apart") {
  SlumpTest test;
  const auto key = evaluation_key("p", test);
  CHECK(key == evaluation_key("p", test));
  CHECK(key != evaluation_key("q", test));
  const auto with = [&](auto change) {
    SlumpTest other = test;
    change(other);
    return evaluation_key("p", other);
  };
  CHECK(key != with([](SlumpTest& other) { other.packing_seed += 1; }));
  CHECK(key != with([](SlumpTest& other) { other.lift_velocity_m_s *= 2; }));
  CHECK(key != with([](SlumpTest& other) { other.grains.radius_m = std::nextafter(other.grains.radius_m, 1); }));
  CHECK(key != with([](SlumpTest& other) { other.contact.bridge.c_n += 1e-12; }));
  CHECK(key != with([](SlumpTest& other) { other.reading.outline_step1 = {{-0.1, 0}, {0.1, 0.05}}; }));
}

TEST_CASE("threads may add to one store at the same time") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  {
    auto store = opened(file);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&store, t] {
        for (std::uint64_t i = 0; i < 10; ++i) (void)store.add(evaluation(0.1 * t, i));
      });
    for (auto& thread : threads) thread.join();
  }
  CHECK(opened(file).size() == 40);
}

TEST_CASE("a store of another program is refused, named and left as it was") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  CHECK(opened(file).add(evaluation(0.5)).empty());
  const auto before = test::content(file);
  const auto other = Store::open(file, {"pastefit 0.2.0", kIdentity.inputs});
  REQUIRE_FALSE(other.ok());
  REQUIRE(other.faults().size() == 1);
  CHECK_THAT(other.faults()[0].where, Catch::EndsWith("program"));
  CHECK_THAT(other.faults()[0].what, Catch::Contains(kIdentity.program) && Catch::Contains("pastefit 0.2.0"));
  CHECK_THAT(other.faults()[0].remedy, Catch::Contains("--force"));
  CHECK(test::content(file) == before);
}

TEST_CASE("changed inputs are named, and begin an epoch that keeps what is known") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  CHECK(opened(file).changes().empty());
  CHECK(opened(file).add(evaluation(0.5)).empty());
  auto inputs = nlohmann::json::parse(kIdentity.inputs);
  inputs["study"]["parameters"]["friction"]["free"][0] = 0.2;
  inputs["study"]["search"]["packings"] = 3;
  inputs["laboratories"][0]["laboratory"]["measurements"]["step1.height_mm"] = {{"repeats", {1, 2}}};
  const StoreIdentity changed{kIdentity.program, inputs.dump()};
  {
    auto store = opened(file, changed);
    const auto& places = store.changes();
    INFO(nlohmann::json(places).dump());
    CHECK(std::ranges::count(places, "study.parameters.friction.free") == 1);
    CHECK(std::ranges::count(places, "study.search.packings") == 1);
    CHECK(std::ranges::any_of(places, [](const std::string& place) {
      return place.starts_with("laboratories[0].laboratory.measurements.step1.height_mm");
    }));
    CHECK(store.epoch() == 2);
    REQUIRE(store.find(evaluation(0.5).key));
    CHECK(store.find(evaluation(0.5).key)->epoch == 1);
    CHECK(store.add(evaluation(0.6)).empty());
    CHECK(store.find(evaluation(0.6).key)->epoch == 2);
  }
  const auto again = opened(file, changed);
  CHECK(again.changes().empty());
  CHECK(again.epoch() == 2);
  CHECK(again.all().at(1).epoch == 2);
}

TEST_CASE("a store whose folder does not exist is a fault, not an exception") {
  const auto store = Store::open("/nowhere/evaluations.sqlite", kIdentity);
  REQUIRE_FALSE(store.ok());
  CHECK_THAT(store.faults()[0].where, Catch::Contains("/nowhere"));
}

// Depends on the disk, so it is run by hand: test_calibrate "[overhead]" -s
TEST_CASE("to store an evaluation and to find it again takes less than a hundredth of the quickest simulation",
          "[.][overhead]") {
  constexpr double kQuickestSimulation_s = 0.2;  // 10 mm grains, one step
  constexpr int kEvaluations = 500;
  const Folder folder;
  Store store = opened(folder.path() / "evaluations.sqlite");
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kEvaluations; ++i) {
    const StoredEvaluation one = evaluation(0.001 * i);
    REQUIRE(store.add(one).empty());
    REQUIRE(store.find(one.key));
  }
  const double each_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kEvaluations;
  INFO(1e3 * each_s << " ms each");
  CHECK(each_s < 0.01 * kQuickestSimulation_s);
}
