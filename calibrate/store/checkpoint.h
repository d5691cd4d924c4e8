#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibrate/laboratory/test.h"
#include "core/result.h"

namespace pastefit {

/// How far a run has come.
struct RunState {
  std::string bytes;  ///< of its `RunCheckpoint`; empty: it has not begun
  double wall_s = 0;  ///< that it has taken so far
};

/// The state of one run in a file, from which the same run can go on in another process. One line each: format,
/// program, run, time that was taken, hash of the state; then the state.
class Checkpoint {
 public:
  /// `options`: those that change the bits of the run are part of its name.
  Checkpoint(std::filesystem::path file, const Test& test, const RunOptions& options);

  /// What the file holds; an empty state if there is none.
  /// Errors: it cannot be read, is no checkpoint, is damaged, or was written by another program or for another run.
  Result<RunState> read() const;

  /// Replaces the file, whole or not at all. Errors: it cannot be written.
  Faults write(const RunState& state) const;

  /// The fault of a state that the run which went on from it found not to be its own, for this reason (`BadState`).
  Faults no_state_of_this_run(std::string_view why) const;

  /// The run is over.
  void remove() const;

 private:
  std::filesystem::path file_;
  std::string run_;
};

}  // namespace pastefit
