#pragma once

#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "calibrate/laboratory/slump.h"
#include "calibrate/store/store.h"
#include "calibrate/study/parameters.h"

namespace pastefit::test {

inline const StoreIdentity kIdentity{"pastefit 0.1.0 engine abc",
                                     R"({"study": {"parameters": {"friction": {"free": [0, 1]}}, "search": {"seed": 1}},
                                  "laboratories": [{"laboratory": {"measurements": {"step1.height_mm": {"value": 1}}}}]})"};

/// Some simulation, of numbers that need all their digits.
inline StoredEvaluation evaluation(double value, std::uint64_t packing = 7) {
  StoredEvaluation out;
  out.point = {value, 0.1 + 0.2};
  out.values = default_values();
  out.values[0] = value * 3000;
  out.values[5] = 1.0 / 3;
  out.packing = packing;
  SlumpTest test;
  test.contact.friction = value;
  test.packing_seed = packing;
  out.key = evaluation_key(kIdentity.program, test);
  out.readings.set("step1.height_mm", 100 * std::nextafter(value, 2.0));
  out.readings.set("fill.mass_kg", 9.9999999999999982);
  out.run = {.particles = 1250,
             .steps = 60000,
             .particle_steps = 75000000,
             .time_step_s = 4.1e-5,
             .simulated_s = 2.46,
             .settled = true,
             .energy_error = 1e-4};
  out.wall_s = 1.9;
  out.core_s = 1.7;
  return out;
}

inline Store opened(const std::filesystem::path& file, const StoreIdentity& identity = kIdentity) {
  auto store = Store::open(file, identity);
  INFO((store.ok() ? "" : store.faults()[0].where + ": " + store.faults()[0].what));
  REQUIRE(store.ok());
  return std::move(store).value();
}

inline void execute(const std::filesystem::path& file, const char* sql) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

}  // namespace pastefit::test
