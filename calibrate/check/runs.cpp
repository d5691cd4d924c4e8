#include "calibrate/check/runs.h"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>

#include "calibrate/base/machine.h"

namespace pastefit {

std::vector<Outcome> run_packings(const Test& test, const std::vector<std::uint64_t>& packings,
                                  const CheckEngine& engine, int threads) {
  std::vector<Outcome> outcomes(packings.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < packings.size(); i = next++) {
      Test one = test;
      specimen_of(one).packing_seed = packings[i];
      RunOptions options;
      options.packing = engine.prepare(one, {});
      outcomes[i] = engine.run(one, options);
    }
  };
  const auto cores = static_cast<std::size_t>(threads > 0 ? threads : processors());
  std::vector<std::jthread> workers;
  try {
    for (std::size_t i = 1; i < std::min(cores, packings.size()); ++i) workers.emplace_back(work);
  } catch (const std::system_error&) {
    // As many threads as the system lets us have.
  }
  work();
  workers.clear();
  return outcomes;
}

std::vector<Baseline::Run> accepted(const Test& test, const std::vector<Baseline::Run>& runs) {
  std::vector<Observables> all;
  for (const Baseline::Run& run : runs) all.push_back(run.observables);
  std::vector<Baseline::Run> out;
  for (const std::size_t run : accepted(test, all)) out.push_back(runs[run]);
  return out;
}

std::vector<double> column_of(const std::vector<Baseline::Run>& runs, const std::string& name) {
  std::vector<double> column;
  for (const auto& run : runs)
    if (const auto value = run.observables.find(name)) column.push_back(*value);
  return column;
}

}  // namespace pastefit
