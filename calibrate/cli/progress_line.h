#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "calibrate/search/evaluator.h"
#include "calibrate/search/strategy.h"

namespace pastefit {

/// Live progress on standard output: one line that is rewritten on a terminal; elsewhere a plain line at the start of
/// each phase and every few seconds. Thread-safe.
class ProgressLine {
 public:
  ProgressLine(int budget, const MisfitUnit& unit);
  void show(const Progress& progress);        ///< from the search
  void show(const EvaluationCounts& counts);  ///< after each simulation
  void end();                                 ///< ends the rewritten line

 private:
  void rewrite(bool now);
  std::string text() const;

  using Clock = std::chrono::steady_clock;
  const Clock::time_point start_ = Clock::now();
  const bool terminal_;
  const int budget_;
  const MisfitUnit unit_;
  std::mutex mutex_;
  std::string phase_ = "start";
  double best_miss_ = -1;
  EvaluationCounts counts_;
  Clock::time_point printed_{};
  std::string last_;
};

}  // namespace pastefit
