#pragma once

#include <mutex>
#include <string>

#include "calibrate/check/check.h"
#include "calibrate/cli/status_line.h"

namespace pastefit {

/// Tells how many of some pieces of work are done and what is left of them, once they have taken two seconds
/// (`status_line.h`). Thread-safe.
class WorkLine {
 public:
  /// `pieces`: what they are, e.g. "simulations".
  WorkLine(std::string pieces, int total);
  ~WorkLine();
  WorkLine(const WorkLine&) = delete;
  WorkLine& operator=(const WorkLine&) = delete;

  void one_done();
  void look();  ///< to be called now and then while a piece is under way
  /// Leaves the line of a terminal to what is printed next.
  void clear();

 private:
  std::string text() const;

  const std::string pieces_;
  const int total_;
  std::mutex mutex_;
  StatusLine line_;
  int done_ = 0;
};

/// An engine whose simulations are the pieces of this work, which it must not outlive.
CheckEngine counted(CheckEngine engine, WorkLine& line);

}  // namespace pastefit
