#include "core/step/run_checkpoint.h"

#include <utility>

#include "core/step/state.h"

namespace pastefit {

RunCheckpoint::RunCheckpoint(std::function<bool()> due, std::function<void(const std::string&)> keep,
                             std::string_view state)
    : due_(std::move(due)), keep_(std::move(keep)) {
  if (state.empty()) return;
  StateReader reader(state);
  reader(ended_, interrupted_.emplace());
  reader.end();
  demand(!interrupted_->hidden.empty(), "the wait that was under way left nothing");
}

const RunCheckpoint::Wait* RunCheckpoint::next_ended() {
  return interrupted_ && told_ < ended_.size() ? &ended_[told_++] : nullptr;
}

std::optional<RunCheckpoint::Wait> RunCheckpoint::take_interrupted() {
  return std::exchange(interrupted_, std::nullopt);
}

std::size_t RunCheckpoint::add(Wait ended, std::optional<std::size_t> before) {
  if (before) ended_[*before].hidden.clear();
  ended_.push_back(std::move(ended));
  return ended_.size() - 1;
}

void RunCheckpoint::keep(Wait under_way) {
  StateWriter state;
  state(ended_, under_way);
  keep_(state.take());
}

}  // namespace pastefit
