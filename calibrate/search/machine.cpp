#include "calibrate/search/machine.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

#include "core/rigs/packing.h"

namespace pastefit {

namespace {

constexpr double kBytesPerGrain = 1000;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

int processors() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

double memory_available_bytes() {
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;) {
    double kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  }
  return std::numeric_limits<double>::infinity();
}

double memory_needed_bytes(const SlumpTable& test) {
  return kBytesPerGrain * poured_grains(test);
}

Faults validate_memory(const SlumpTable& test, int at_once) {
  const int simulations = at_once > 0 ? at_once : processors();
  const double needed = simulations * memory_needed_bytes(test), free = memory_available_bytes();
  if (needed <= free) return {};
  return {{"grains",
           number(poured_grains(test)) + " grains in " + std::to_string(simulations) +
               (simulations == 1 ? " simulation" : " simulations at a time") + " need about " + number(needed / 1e9) +
               " GB of memory, " + number(free / 1e9) + " GB are free",
           simulations > 1 && needed / simulations <= free ? "give fewer --threads, or take larger grains"
                                                           : "take larger grains"}};
}

Faults validate_memory(const Study& study, int at_once) {
  for (const StudyTest& test : study.tests)
    if (auto faults = validate_memory(test.lab.test, at_once); !faults.empty()) return faults;
  return {};
}

}  // namespace pastefit
