#include "calibrate/report/run_recordings.h"

#include <utility>

#include "calibrate/store/store.h"

namespace pastefit {

namespace {

std::string key_of_test(const Test& test) {
  return evaluation_key("", test);
}

/// Of the test with this material, whatever the packing.
std::string name_of_material(Test test) {
  specimen_of(test).packing_seed = 0;
  return key_of_test(test);
}

}  // namespace

void SeenSimulation::see(const Test& test, const Snapshot& snapshot) {
  if (snapshot.world)
    if (auto outline = outline_at(test, snapshot))
      seen.outlines.insert_or_assign(std::string(outline->name), std::move(outline->outline));
  if (film) film->add(snapshot);
}

void SeenSimulation::end(const Outcome& outcome) {
  failure = outcome.failure;
  seen.readings = outcome.readings;
  seen.curve = outcome.curve;
  ended = true;
}

RunObserver::Watch RunRecordings::begin(const Test& test) {
  constexpr std::size_t kMostFilms = 8;
  const std::lock_guard lock(mutex_);
  std::unique_ptr<SeenSimulation>& look = recordings_[key_of_test(test)];
  look = std::make_unique<SeenSimulation>();
  look->seen.packing = specimen_of(test).packing_seed;
  if (filmed_.size() < kMostFilms && filmed_.insert(name_of_material(test)).second) look->film.emplace();
  return [test, look = look.get()](const Snapshot& snapshot) { look->see(test, snapshot); };
}

void RunRecordings::end(const Test& test, const Outcome& outcome) {
  const std::lock_guard lock(mutex_);
  recordings_.at(key_of_test(test))->end(outcome);
}

std::optional<SeenSimulation> RunRecordings::take(const Test& test) {
  const std::lock_guard lock(mutex_);
  const auto found = recordings_.find(key_of_test(test));
  if (found == recordings_.end() || !found->second->ended) return std::nullopt;
  const auto look = std::move(found->second);
  recordings_.erase(found);
  return std::move(*look);
}

}  // namespace pastefit
