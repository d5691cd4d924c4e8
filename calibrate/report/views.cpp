#include "calibrate/report/views.h"

#include <algorithm>
#include <utility>

#include "calibrate/base/machine.h"
#include "calibrate/search/worker_pool.h"

namespace pastefit {

namespace {

/// One simulation, and what is seen of it.
struct Look {
  SeenRun seen;
  FilmRecorder film;
  std::optional<Failure> failure;
};

void take(Look& look, Test test, std::uint64_t packing, bool filmed, const std::function<bool()>& goes_on) {
  look.seen.packing = packing;
  specimen_of(test).packing_seed = packing;
  RunOptions options;
  options.watch_interval_s = FilmRecorder::kInterval;
  options.watch = [&](const Moment& moment) {
    if (moment.world)
      if (auto outline = outline_at(test, moment))
        look.seen.outlines.insert_or_assign(std::string(outline->name), std::move(outline->outline));
    if (filmed) look.film.add(moment);
    return goes_on();
  };
  Outcome outcome = simulate(test, options);
  look.failure = std::move(outcome.failure);
  look.seen.readings = std::move(outcome.observables);
  look.seen.curve = std::move(outcome.curve);
}

}  // namespace

TestView view_of(const CardTest& test, std::span<const std::uint64_t> packings, int threads,
                 const std::function<bool()>& goes_on) {
  std::vector<Look> looks(packings.size());
  {
    WorkerPool pool(threads > 0 ? threads : processors());
    std::vector<std::shared_future<void>> done;
    for (std::size_t i = 0; i < packings.size(); ++i)
      done.push_back(pool.submit([&, i] { take(looks[i], test.test, packings[i], i == 0, goes_on); }));
    for (auto& one : done) one.get();
  }
  TestView view;
  for (Look& look : looks) {
    if (look.failure)
      view.failures.push_back("packing " + std::to_string(look.seen.packing) + ": " + look.failure->message);
    else
      view.runs.push_back(std::move(look.seen));
  }
  if (!looks.empty()) view.film = std::move(looks.front().film).film();
  return view;
}

}  // namespace pastefit
