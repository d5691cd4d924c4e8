#include "calibrate/search/memory.h"

#include <string>

#include "calibrate/base/format.h"
#include "calibrate/base/machine.h"

namespace pastefit {

namespace {

constexpr double kBytesPerGrain = 1000;

}  // namespace

double memory_needed_bytes(const Test& test) {
  return kBytesPerGrain * grains_needed(test);
}

Faults validate_memory(const Test& test, int at_once) {
  const int simulations = at_once > 0 ? at_once : processors();
  const double needed = simulations * memory_needed_bytes(test), free = memory_available_bytes();
  if (needed <= free) return {};
  return {{"grains",
           format("%.3g", grains_needed(test)) + " grains in " + std::to_string(simulations) +
               (simulations == 1 ? " simulation" : " simulations at a time") + " need about " +
               format("%.3g", needed / 1e9) + " GB of memory, " + format("%.3g", free / 1e9) + " GB are free",
           simulations > 1 && needed / simulations <= free ? "give fewer --threads, or take larger grains"
                                                           : "take larger grains"}};
}

Faults validate_memory(const Study& study, int at_once) {
  for (const StudyTest& test : study.tests)
    if (auto faults = validate_memory(test.lab.test, at_once); !faults.empty()) return faults;
  return {};
}

}  // namespace pastefit
