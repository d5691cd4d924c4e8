#include "calibrate/check/runs.h"

#include <future>
#include <utility>

#include "calibrate/base/machine.h"
#include "calibrate/base/worker_pool.h"

namespace pastefit {

std::vector<Outcome> outcomes_of(const Test& test, const std::vector<std::uint64_t>& packings,
                                 const CheckEngine& engine, int threads) {
  std::vector<Outcome> outcomes(packings.size());
  WorkerPool pool(threads > 0 ? threads : processors());
  std::vector<std::shared_future<void>> done;
  for (std::size_t i = 0; i < packings.size(); ++i)
    done.push_back(pool.submit([&, i] {
      Test one = test;
      specimen_of(one).packing_seed = packings[i];
      RunOptions options;
      options.packing = engine.prepare(one, {});
      outcomes[i] = engine.run(one, options);
    }));
  for (const auto& one : done) one.get();  // rethrows exceptions of the engine
  return outcomes;
}

Fault failure_in(std::uint64_t packing, const Failure& failure, const std::string& heading) {
  return {heading + "packing " + std::to_string(packing),
          "failed (" + std::string(name_of(failure.reason)) + " in " + failure.phase + ")", failure.message};
}

Result<std::vector<Baseline::Run>> baseline_runs(const Test& test, const std::string& heading,
                                                 const std::vector<std::uint64_t>& packings, const CheckEngine& engine,
                                                 int threads) {
  std::vector<Outcome> outcomes = outcomes_of(test, packings, engine, threads);
  std::vector<Baseline::Run> runs;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (const auto& failure = outcomes[i].failure) return failure_in(packings[i], *failure, heading);
    runs.push_back({packings[i], std::move(outcomes[i].readings)});
  }
  return runs;
}

}  // namespace pastefit
