#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "calibrate/laboratory/slump.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/store/store.h"
#include "calibrate/study/parameters.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;
using test::Folder;

namespace {

const StoreIdentity kIdentity{"pastefit 0.1.0 engine abc",
                              R"({"study": {"parameters": {"friction": {"free": [0, 1]}}, "search": {"seed": 1}},
                                  "laboratories": [{"laboratory": {"measurements": {"step1.height_mm": {"value": 1}}}}]})"};

StoredEvaluation evaluation(double value, std::uint64_t packing = 7) {
  StoredEvaluation out;
  out.point = {value, 0.1 + 0.2};
  out.values = usual_values();
  out.values[0] = value * 3000;
  out.values[5] = 1.0 / 3;
  out.packing = packing;
  SlumpTest test;
  test.contact.friction = value;
  test.packing_seed = packing;
  out.key = evaluation_key(kIdentity.program, test);
  out.observables.set("step1.height_mm", 100 * std::nextafter(value, 2.0));
  out.observables.set("fill.mass_kg", 9.9999999999999982);
  out.run = {.particles = 1250,
             .steps = 60000,
             .particle_steps = 75000000,
             .time_step_s = 4.1e-5,
             .simulated_s = 2.46,
             .settled = true,
             .energy_error = 1e-4};
  out.wall_s = 1.9;
  return out;
}

Store opened(const std::filesystem::path& file, const StoreIdentity& identity = kIdentity) {
  auto store = Store::open(file, identity);
  INFO((store.ok() ? "" : store.faults()[0].where + ": " + store.faults()[0].what));
  REQUIRE(store.ok());
  return std::move(store).value();
}

void execute(const std::filesystem::path& file, const char* sql) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

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
  REQUIRE(found->observables.all().size() == 2);
  CHECK(found->observables.all()[0].name == "step1.height_mm");
  CHECK(same_bits(found->observables.all()[0].value, kept.observables.all()[0].value));
  CHECK(same_bits(found->observables.all()[1].value, kept.observables.all()[1].value));
  CHECK_FALSE(found->failure);
  CHECK(found->run.particle_steps == kept.run.particle_steps);
  CHECK(same_bits(found->run.time_step_s, kept.run.time_step_s));
  CHECK(same_bits(found->wall_s, kept.wall_s));
  CHECK(found->sketch.heap);
  CHECK(found->sketch.points == kept.sketch.points);
}

TEST_CASE("parameters are kept by name, those that are not usual, and one that is absent has its usual value") {
  auto values = usual_values();
  values[0] = 1234.5;
  values[5] = 1.0 / 3;
  const nlohmann::json kept = parameters_to_json(values);
  CHECK(kept == nlohmann::json{{"friction", 1.0 / 3}, {"strength_pa", 1234.5}});
  CHECK(parameters_from_json(kept) == values);
  CHECK(parameters_from_json(nlohmann::json::object()) == usual_values());
  CHECK_THROWS_AS(parameters_from_json({{"stickiness", 1}}), std::invalid_argument);
}

TEST_CASE("a field that is added with its usual value leaves the name of an evaluation as it was") {
  SlumpTest test;
  test.contact.friction = 0.15;
  test.drop.emplace().mass_kg = 12;
  const auto usual = usual_test(test);
  CHECK(identity_of(test)[0] == "slump");
  const auto before = differing_part(to_json(test), to_json(usual));
  CHECK(identity_of(test)[1] == before);
  CHECK(before == nlohmann::json{{"contact", {{"friction", 0.15}}}, {"drop", {{"mass_kg", 12.0}}}});
  auto larger_test = to_json(test), larger_usual = to_json(usual);
  for (auto* one : {&larger_test, &larger_usual}) {
    (*one)["contact"]["throwaway"] = 0.7;
    (*one)["drop"]["bounces"] = nullptr;
    (*one)["reading"]["outline_step3_m"] = nlohmann::json::array();
  }
  CHECK(differing_part(larger_test, larger_usual) == before);
  larger_test["contact"]["throwaway"] = 0.8;
  CHECK(differing_part(larger_test, larger_usual) != before);
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
  kept.observables = {};
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
  CHECK(found->observables.all().empty());
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

TEST_CASE("a file that is not a store is refused and left as it was") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  SECTION("text") {
    std::ofstream(file) << std::string(5000, 'x');
  }
  SECTION("another database") {
    execute(file, "CREATE TABLE people (name TEXT)");
  }
  SECTION("another schema version") {
    CHECK(opened(file).add(evaluation(0.5)).empty());
    execute(file, "PRAGMA user_version = 99");
  }
  SECTION("a damaged record of the study") {
    CHECK(opened(file).add(evaluation(0.5)).empty());
    execute(file, "UPDATE inputs SET content = replace(content, '1', '2')");
  }
  SECTION("cut short") {
    {
      auto store = opened(file);
      for (int i = 0; i < 50; ++i) CHECK(store.add(evaluation(0.01 * i)).empty());
    }
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  }
  const auto before = test::content(file);
  const auto store = Store::open(file, kIdentity);
  REQUIRE_FALSE(store.ok());
  CHECK_THAT(store.faults()[0].where, Catch::Contains("evaluations.sqlite"));
  CHECK_FALSE(store.faults()[0].remedy.empty());
  CHECK(test::content(file) == before);
}

TEST_CASE("a damaged evaluation is named, set aside, and kept anew") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  {
    auto store = opened(file);
    for (int i = 0; i < 3; ++i) CHECK(store.add(evaluation(0.1 * i)).empty());
    CHECK(store.remarks().empty());
  }
  SECTION("a reading") {
    execute(file, "UPDATE evaluations SET observables = replace(observables, '9', '8') WHERE sequence = 2");
  }
  SECTION("the parameters") {
    execute(file, "UPDATE evaluations SET parameter_values = '{}' WHERE sequence = 2");
  }
  SECTION("the name") {
    execute(file, "UPDATE evaluations SET key = (SELECT key FROM evaluations WHERE sequence = 1) WHERE sequence = 2");
  }
  SECTION("the order") {
    execute(file, "UPDATE evaluations SET sequence = 7 WHERE sequence = 2");
  }
  SECTION("what is no JSON") {
    execute(file, "UPDATE evaluations SET failure = '{\"reason\": \"moonlight' WHERE sequence = 2");
  }
  {
    auto store = opened(file);
    REQUIRE(store.remarks().size() == 1);
    CHECK_THAT(store.remarks()[0], Catch::Contains("evaluation 2") || Catch::Contains("evaluation 7"));
    CHECK(store.size() == 2);
    CHECK(store.find(evaluation(0).key));
    CHECK_FALSE(store.find(evaluation(0.1).key));
    CHECK(store.add(evaluation(0.1)).empty());
  }
  const auto again = opened(file);
  CHECK(again.remarks().empty());
  CHECK(again.size() == 3);
  CHECK(again.find(evaluation(0.1).key));
}

TEST_CASE("evaluations that are missing are said") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  {
    auto store = opened(file);
    for (int i = 0; i < 3; ++i) CHECK(store.add(evaluation(0.1 * i)).empty());
  }
  SECTION("the last one") {
    execute(file, "DELETE FROM evaluations WHERE sequence = 3");
    REQUIRE(opened(file).remarks().size() == 1);
    CHECK_THAT(opened(file).remarks()[0], Catch::Contains("of 3") && Catch::Contains("2 are there"));
  }
  SECTION("all of them and the file's content") {
    std::filesystem::resize_file(file, 0);
    const auto store = opened(file);
    REQUIRE(store.remarks().size() == 1);
    CHECK_THAT(store.remarks()[0], Catch::Contains("empty"));
  }
}

TEST_CASE("whichever bit of a store is flipped, no evaluation is another one in silence") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite", broken = folder.path() / "broken.sqlite";
  std::vector<StoredEvaluation> kept;
  {
    auto store = opened(file);
    for (int i = 0; i < 3; ++i) CHECK(store.add(evaluation(0.1 * i)).empty());
    kept = store.all();
  }
  const auto text_of = [](const StoredEvaluation& one) {
    return one.key + nlohmann::json(one.point).dump() + nlohmann::json(one.values).dump() +
           std::to_string(one.packing) + to_json(one.observables).dump() + to_json(one.run, one.wall_s).dump() +
           std::to_string(one.epoch);
  };
  const std::string whole = test::content(file);
  int set_aside = 0, refused = 0;
  for (std::size_t byte = 0; byte < whole.size(); byte += 11) {
    std::string flipped = whole;
    flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << byte % 8));
    std::ofstream(broken, std::ios::binary) << flipped;
    for (const char* suffix : {"-wal", "-shm"}) std::filesystem::remove(broken.string() + suffix);
    const auto store = Store::open(broken, kIdentity);
    if (!store.ok()) {
      ++refused;
      continue;
    }
    const auto found = store.value().all();
    set_aside += found.size() < kept.size();
    INFO("byte " << byte);
    if (found.size() < kept.size()) CHECK_FALSE(store.value().remarks().empty());
    for (const auto& one : found)
      CHECK(std::ranges::any_of(kept, [&](const auto& other) { return text_of(one) == text_of(other); }));
  }
  CHECK(set_aside > 20);
  CHECK(refused > 0);
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
