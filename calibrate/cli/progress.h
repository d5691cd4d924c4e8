#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <utility>

#include "calibrate/check/check.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/search/search.h"
#include "core/step/run.h"

namespace pastefit {

/// Progress on standard error: one line, rewritten in place on a terminal, otherwise a plain line at intervals. Silent
/// in quiet mode. Thread-safe.
class StatusLine {
 public:
  using Clock = std::chrono::steady_clock;
  /// Shows the first line after `first`, the next after 0.2 s on a terminal, 4 s elsewhere.
  explicit StatusLine(Clock::duration first = std::chrono::seconds(2));
  ~StatusLine() { clear(); }

  bool is_terminal() const { return terminal_; }
  double gone_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Shows `text()` if a line is due, or if `at_once`.
  template <class Text>
  void look(Text text, bool at_once = false) {
    const std::lock_guard lock(mutex_);
    if (at_once || Clock::now() >= next_) show(text());
  }
  void clear();  ///< removes a rewritten line
  void keep();   ///< keeps it and continues below

 private:
  void show(const std::string& line);

  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;  // guards what follows
  Clock::time_point next_;
  std::string shown_;
};

/// Run options with progress output, shown during their lifetime; the run ends when `stop`, which must outlive them,
/// becomes true. The remaining time is that of the current phase, a range at its rate so far. There is no estimate for
/// the whole test: phases differ in speed, and the time to rest is not known in advance.
RunOptions shown_run(const std::atomic<bool>* stop = nullptr);

/// Progress of a number of pieces of work (`StatusLine`). Thread-safe.
class WorkLine {
 public:
  /// `pieces`: plural noun, e.g. "simulations".
  WorkLine(std::string pieces, int total) : pieces_(std::move(pieces)), total_(total) {}

  void one_done();
  void look();  ///< call from time to time during a piece
  /// Removes the line before other output.
  void clear() { line_.clear(); }

 private:
  const std::string pieces_;
  const int total_;
  std::atomic<int> done_ = 0;
  StatusLine line_;
};

/// Engine that counts its simulations in `line`, which must outlive it.
CheckEngine counted(CheckEngine engine, WorkLine& line);

/// Progress of a calibration (`StatusLine`): on a terminal, a line cut to its width, with a bar if there is room;
/// elsewhere at most 80 columns, at the start of each phase and every few seconds. Thread-safe. The remaining time is a
/// range: from the rest of the phases if the next candidate is confirmed, to the rest of the budget, both at the mean
/// rate.
class ProgressLine {
 public:
  /// `study` must outlive the line.
  explicit ProgressLine(const Study& study) : line_(StatusLine::Clock::duration::zero()), study_(study) {}
  void show(const Progress& progress);        ///< from the search
  void show(const EvaluationCounts& counts);  ///< after each simulation
  void look();                                ///< from time to time during a simulation
  void end();                                 ///< ends the rewritten line

 private:
  std::string text() const;
  std::string bar(std::size_t columns) const;
  std::string time_left() const;

  StatusLine line_;
  const Study& study_;
  std::mutex mutex_;
  std::string phase_ = "start";
  int done_before_ = 0;  // before the current phase
  double best_error_ = -1;
  EvaluationCounts counts_;
};

}  // namespace pastefit
