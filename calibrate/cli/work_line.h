#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "calibrate/check/check.h"

namespace pastefit {

/// Tells on standard error, unless it is quiet, how many of some pieces of work are done and what is left of them, once
/// they have taken two seconds: rewritten in place on a terminal, else a line every ten seconds. Thread-safe.
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
  using Clock = std::chrono::steady_clock;
  std::string text(Clock::time_point now) const;

  const std::string pieces_;
  const int total_;
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  int done_ = 0;
  bool shown_ = false;
  Clock::time_point next_;
};

/// An engine whose simulations are the pieces of this work, which it must not outlive.
CheckEngine counted(CheckEngine engine, WorkLine& line);

}  // namespace pastefit
