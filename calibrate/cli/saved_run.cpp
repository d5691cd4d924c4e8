#include "calibrate/cli/saved_run.h"

#include <utility>

#include "core/step/state.h"

namespace pastefit {

Result<std::shared_ptr<RunCheckpoint>> SavedRun::checkpoint() {
  try {
    return std::make_shared<RunCheckpoint>([this] { return stop_ || Clock::now() > next_; },
                                           [this](const std::string& state) { keep(state); },
                                           std::exchange(found_.bytes, {}));
  } catch (const BadState& bad) {
    return file_.no_state_of_this_run(bad.what());
  }
}

Result<Outcome> SavedRun::simulate(const Scene& scene, const RunOptions& run) const {
  try {
    Outcome outcome = pastefit::simulate(scene, run);
    if (run.checkpoint->is_told()) return outcome;
    return file_.no_state_of_this_run("it holds more than this run has");
  } catch (const BadState& bad) {
    return file_.no_state_of_this_run(bad.what());
  }
}

void SavedRun::keep(const std::string& state) {
  unwritten_ = file_.write({state, wall_s()});
  next_ = Clock::now() + kBetween;
}

}  // namespace pastefit
