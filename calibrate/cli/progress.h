#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <utility>

#include "calibrate/check/check.h"
#include "calibrate/evaluate/evaluator.h"
#include "calibrate/search/search.h"
#include "core/step/run.h"

namespace pastefit {

/// Where some work is, on standard error: one line that is rewritten in place on a terminal, else a plain line now and
/// then. Nothing while the program is quiet. Thread-safe.
class StatusLine {
 public:
  using Clock = std::chrono::steady_clock;
  /// The first line is due after this time, another one after 0.2 s on a terminal, after 4 s elsewhere.
  explicit StatusLine(Clock::duration first = std::chrono::seconds(2));
  ~StatusLine() { clear(); }

  bool is_terminal() const { return terminal_; }
  double gone_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Shows what `text()` says, if a line is due or is to come at once.
  template <class Text>
  void look(Text text, bool at_once = false) {
    const std::lock_guard lock(mutex_);
    if (at_once || Clock::now() >= next_) show(text());
  }
  void clear();  ///< takes a rewritten line away
  void keep();   ///< leaves it as it is, and goes on below

 private:
  void show(const std::string& line);

  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;  // guards what follows
  Clock::time_point next_;
  std::string shown_;
};

/// Options of a run that shows where it is, as long as they live, and ends when `stop` becomes true, which has to
/// outlive them. The time that is left is that of the phase, a range at its rate so far. Of the whole test there is
/// none: a heap rests when it does, and each phase has a pace of its own.
RunOptions shown_run(const std::atomic<bool>* stop = nullptr);

/// Tells how many of some pieces of work are done and what is left of them (`StatusLine`). Thread-safe.
class WorkLine {
 public:
  /// `pieces`: what they are, e.g. "simulations".
  WorkLine(std::string pieces, int total) : pieces_(std::move(pieces)), total_(total) {}

  void one_done();
  void look();  ///< to be called now and then while a piece is under way
  /// Leaves the line of a terminal to what is printed next.
  void clear() { line_.clear(); }

 private:
  const std::string pieces_;
  const int total_;
  std::atomic<int> done_ = 0;
  StatusLine line_;
};

/// An engine whose simulations are the pieces of this work, which it must not outlive.
CheckEngine counted(CheckEngine engine, WorkLine& line);

/// Simulations of a calibration, in every test that is fitted.
struct WorkAhead {
  int budget = 0;        ///< at most, in all
  int screening = 0;     ///< before the search
  int confirmation = 0;  ///< of a candidate that holds
  int examination = 0;   ///< after the search, hold-outs included
};

/// Live progress (`StatusLine`): on a terminal a line cut to its width, with a bar where there is room; elsewhere
/// one of at most 80 columns at the start of each phase and every few seconds. Thread-safe.
///
/// The time that is left is a range: from what the phases still have to do if the next candidate holds, to what the
/// budget allows, both at the rate of simulations so far.
class ProgressLine {
 public:
  ProgressLine(const WorkAhead& work, const ErrorUnit& unit);
  void show(const Progress& progress);        ///< from the search
  void show(const EvaluationCounts& counts);  ///< after each simulation
  void look();                                ///< now and then during one
  void end();                                 ///< ends the rewritten line

 private:
  std::string text() const;
  std::string bar(std::size_t columns) const;
  std::string time_left() const;
  int done() const { return counts_.simulated + counts_.answered; }

  StatusLine line_;
  const WorkAhead work_;
  const ErrorUnit unit_;
  std::mutex mutex_;
  std::string phase_ = "start";
  int done_before_ = 0;  // the phase
  double best_error_ = -1;
  EvaluationCounts counts_;
};

}  // namespace pastefit
