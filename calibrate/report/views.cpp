#include "calibrate/report/views.h"

#include <algorithm>
#include <utility>

#include "calibrate/base/machine.h"
#include "calibrate/base/worker_pool.h"
#include "calibrate/store/program.h"

namespace pastefit {

namespace {

SeenSimulation look_at(const Test& test, bool filmed, const std::function<bool()>& goes_on) {
  SeenSimulation look;
  look.seen.packing = specimen_of(test).packing_seed;
  if (filmed) look.film.emplace();
  RunOptions options;
  options.watch_interval_s = RunRecorder::kInterval;
  options.watch = [&](const Snapshot& snapshot) {
    look.see(test, snapshot);
    return goes_on();
  };
  look.end(simulate(test, options));
  return look;
}

}  // namespace

TestView view_of(const CardTest& test, std::span<const std::uint64_t> packings, int threads,
                 const std::function<bool()>& goes_on, RunRecordings* seen) {
  std::vector<SeenSimulation> looks(packings.size());
  TestView view;
  view.program = program_identity();
  {
    WorkerPool pool(threads > 0 ? threads : processors());
    std::vector<std::shared_future<void>> done;
    for (std::size_t i = 0; i < packings.size(); ++i) {
      Test one = test.test;
      specimen_of(one).packing_seed = packings[i];
      const bool filmed = i == 0;
      if (auto known = seen ? seen->take(one) : std::nullopt; known && (known->film || !filmed))
        looks[i] = std::move(*known);
      else if (goes_on())
        done.push_back(pool.submit([&, i, one, filmed] { looks[i] = look_at(one, filmed, goes_on); }));
    }
    for (auto& one : done) one.get();
  }
  for (SeenSimulation& look : looks) {
    if (!look.ended || (look.failure && look.failure->reason == FailureReason::stopped && !goes_on()))
      ++view.lacking;
    else if (look.failure)
      view.failures.push_back("packing " + std::to_string(look.seen.packing) + ": " + look.failure->message);
    else
      view.runs.push_back(std::move(look.seen));
  }
  if (!looks.empty() && looks.front().film) view.film = coded(std::move(*looks.front().film).film());
  return view;
}

}  // namespace pastefit
