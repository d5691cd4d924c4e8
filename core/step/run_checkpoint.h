#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

/// How a test goes on after it was interrupted, in another process, with the same bits. Its apparatus does everything
/// once more from the beginning, but a wait of its runners (`Runner::run`, `settle`, ...) that had ended takes no step:
/// it leaves the world as it was left then. The wait in which the test was interrupted goes on in its midst. So an
/// apparatus need not know of it, but for what its phases sum up step by step (`Runner::remember`).
///
/// One checkpoint serves one call of `simulate`. Requirements of a state: it is of the same test, options (but for
/// `StepOptions::threads`), program and instruction set. Not covered: impacts, which take milliseconds.
class RunCheckpoint {
 public:
  /// What a wait leaves behind, as bytes: what an apparatus can see, and what its runner needs to go on besides.
  struct Wait {
    std::string seen, hidden;
    template <class Archive>
    void serialize(Archive& archive) {
      archive(seen, hidden);
    }
  };

  /// `due`: whether a state is asked for, every `kStepsPerPulse` steps; `keep`: takes it. `state`: what `keep` was last
  /// given by the run that is to go on; empty for one that starts. Errors: throws `BadState` (core/step/state.h) where
  /// it is no state at all; the run that goes on does so where it is not one of this run.
  RunCheckpoint(std::function<bool()> due, std::function<void(const std::string& state)> keep,
                std::string_view state = {});

  /// Whether all of the state was told: otherwise it was not one of the run that is over.
  bool is_told() const { return !interrupted_; }

  // For the runner.

  /// The next wait that had ended; none when all of them were told.
  const Wait* next_ended();
  /// The wait that was interrupted, once.
  std::optional<Wait> take_interrupted();
  /// A wait has ended; returns its number. Of the runner's one before (`before`) only what is seen is still needed.
  std::size_t add(Wait ended, std::optional<std::size_t> before);
  std::size_t told() const { return told_; }  ///< of those that had ended
  bool due() const { return due_(); }
  /// Hands out the state of a run that is in the midst of this wait.
  void keep(Wait under_way);

 private:
  std::function<bool()> due_;
  std::function<void(const std::string&)> keep_;
  std::vector<Wait> ended_;
  std::size_t told_ = 0;
  std::optional<Wait> interrupted_;
};

}  // namespace pastefit
