#include "calibrate/report/looks.h"

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

void Look::see(const Test& test, const Moment& moment) {
  if (moment.world)
    if (auto outline = outline_at(test, moment))
      seen.outlines.insert_or_assign(std::string(outline->name), std::move(outline->outline));
  if (film) film->add(moment);
}

void Look::end(const Outcome& outcome) {
  failure = outcome.failure;
  seen.readings = outcome.observables;
  seen.curve = outcome.curve;
  ended = true;
}

Onlooker::Watch Looks::begin(const Test& test) {
  constexpr std::size_t kMostFilms = 8;
  const std::lock_guard lock(mutex_);
  std::unique_ptr<Look>& look = looks_[key_of_test(test)];
  look = std::make_unique<Look>();
  look->seen.packing = specimen_of(test).packing_seed;
  if (filmed_.size() < kMostFilms && filmed_.insert(name_of_material(test)).second) look->film.emplace();
  return [test, look = look.get()](const Moment& moment) { look->see(test, moment); };
}

void Looks::end(const Test& test, const Outcome& outcome) {
  const std::lock_guard lock(mutex_);
  looks_.at(key_of_test(test))->end(outcome);
}

std::optional<Look> Looks::take(const Test& test) {
  const std::lock_guard lock(mutex_);
  const auto found = looks_.find(key_of_test(test));
  if (found == looks_.end() || !found->second->ended) return std::nullopt;
  const auto look = std::move(found->second);
  looks_.erase(found);
  return std::move(*look);
}

}  // namespace pastefit
