#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibrate/laboratory/test.h"
#include "core/result.h"

namespace pastefit {

struct RunState {
  std::string bytes;  ///< of its `RunCheckpoint`; empty: not started
  double wall_s = 0;  ///< time taken so far
};

/// State of one run in a file, from which another process can continue the run. One line each: format, program, run,
/// time taken, hash of the state; then the state.
class Checkpoint {
 public:
  /// `options`: those that change the bits of the run are part of its name.
  Checkpoint(std::filesystem::path file, const Test& test, const RunOptions& options);

  /// Reads the file; an empty state if there is none. Errors: it cannot be read, is not a checkpoint, is damaged, or
  /// was written by another program or for another run.
  Result<RunState> read() const;

  /// Replaces the file atomically. Errors: it cannot be written.
  Faults write(const RunState& state) const;

  /// Error for a state that the resumed run rejects for this reason (`BadState`).
  Faults no_state_of_this_run(std::string_view why) const;

  /// Deletes the file after the end of the run.
  void remove() const;

 private:
  std::filesystem::path file_;
  std::string run_;
};

}  // namespace pastefit
