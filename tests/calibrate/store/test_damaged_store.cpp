#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calibrate/store/outcome_json.h"
#include "tests/calibrate/folder.h"
#include "tests/calibrate/store/stored.h"

using namespace pastefit;
using namespace pastefit::test;

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
  SECTION("what is not JSON") {
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

TEST_CASE("what is stored as a number of steps or grains is a whole number or refused, whatever its size") {
  using nlohmann::json;
  CHECK(whole_number_from_json(json(-1)) == -1);
  CHECK(whole_number_from_json(json(std::int64_t{1} << 62)) == std::int64_t{1} << 62);
  for (const json& other : {json(1.5), json(1.8446744073709552e19), json("7"), json(nullptr)})
    CHECK_THROWS_AS(whole_number_from_json(other), std::invalid_argument);
}

TEST_CASE("a store of another form is refused in words for people, not in those of a library") {
  const Folder folder;
  const auto file = folder.path() / "evaluations.sqlite";
  CHECK(opened(file).add(evaluation(0.5)).empty());
  const char* spoil = GENERATE("UPDATE identity SET value = '' WHERE name = 'evaluations'",
                               "UPDATE identity SET value = 'x' WHERE name = 'evaluations'",
                               "UPDATE identity SET value = '99999999999999999999' WHERE name = 'evaluations'",
                               "DELETE FROM identity WHERE name = 'evaluations'", "DELETE FROM inputs",
                               "DROP TABLE inputs; CREATE TABLE inputs (epoch INTEGER PRIMARY KEY);"
                               "INSERT INTO inputs VALUES (1)",
                               "DROP TABLE evaluations; CREATE TABLE evaluations (sequence INTEGER PRIMARY KEY);"
                               "INSERT INTO evaluations VALUES (1)",
                               "ALTER TABLE evaluations ADD COLUMN more TEXT");
  execute(file, spoil);
  const auto judge = [&](const Result<Store>& store) {
    INFO(spoil);
    REQUIRE_FALSE(store.ok());
    for (const char* word : {"stoi", "stoul", "stoll", "_M_", "vector", "from_chars"})
      CHECK_THAT(store.faults()[0].what, !Catch::Contains(word));
  };
  judge(Store::open(file, kIdentity));
  judge(Store::read(file));
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
           std::to_string(one.packing) + to_json(one.readings).dump() + to_json(one.run, one.wall_s).dump() +
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
