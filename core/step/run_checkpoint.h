#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

/// Resumes an interrupted test in another process, with the same bits. The apparatus repeats everything from the
/// beginning. A wait of its runners (`Runner::run`, `settle`, ...) that had ended takes no step, but restores the world
/// as it was at its end. The interrupted wait continues where it was. So an apparatus need not know about checkpoints,
/// except for what its phases sum up step by step (`Runner::remember`).
///
/// One checkpoint serves one call of `simulate`. Requirements: the state is of the same test, options (except
/// `StepOptions::threads`), program and instruction set. Not covered: impacts and drop tests, which take milliseconds.
class RunCheckpoint {
 public:
  /// State after a wait, as bytes: what an apparatus can see, and what its runner needs besides.
  struct Wait {
    std::string seen, hidden;
    template <class Archive>
    void serialize(Archive& archive) {
      archive(seen, hidden);
    }
  };

  /// `due`: true if a state is wanted, asked every `kStepsPerPulse` steps; `keep`: receives it, and that of a run which
  /// its pulse stops. `state`: the last one given to `keep` by the interrupted run; empty for a new run. Errors: throws
  /// `BadState` (core/step/state.h) if `state` is no state at all; the resumed run throws it if `state` is that of
  /// another run.
  RunCheckpoint(std::function<bool()> due, std::function<void(const std::string& state)> keep,
                std::string_view state = {});

  /// True if all of the state was used; otherwise the state was that of another run.
  bool is_told() const { return !interrupted_; }

  // For the runner.

  /// The next completed wait; null after the last.
  const Wait* next_ended();
  /// The interrupted wait, once.
  std::optional<Wait> take_interrupted();
  /// Adds a completed wait; returns its number. Only the visible part of the runner's previous wait (`before`) is kept.
  std::size_t add(Wait ended, std::optional<std::size_t> before);
  std::size_t told() const { return told_; }  ///< number of completed waits used
  bool due() const { return due_(); }
  /// Passes on the state of a run during this wait.
  void keep(Wait under_way);

 private:
  std::function<bool()> due_;
  std::function<void(const std::string&)> keep_;
  std::vector<Wait> ended_;
  std::size_t told_ = 0;
  std::optional<Wait> interrupted_;
};

}  // namespace pastefit
