#pragma once

#include <mutex>
#include <string>

#include "calibrate/cli/status_line.h"
#include "calibrate/evaluate/evaluator.h"
#include "calibrate/search/search.h"

namespace pastefit {

/// Simulations of a calibration, in every test that is fitted.
struct WorkAhead {
  int budget = 0;        ///< at most, in all
  int screening = 0;     ///< before the search
  int confirmation = 0;  ///< of a candidate that holds
  int examination = 0;   ///< after the search, hold-outs included
};

/// Live progress (`status_line.h`): on a terminal a line cut to its width, with a bar where there is room; elsewhere
/// one of at most 80 columns at the start of each phase and every few seconds. Thread-safe.
///
/// The time that is left is a range: from what the phases still have to do if the next candidate holds, to what the
/// budget allows, both at the rate of simulations so far.
class ProgressLine {
 public:
  ProgressLine(const WorkAhead& work, const ErrorUnit& unit);
  void show(const Progress& progress);        ///< from the search
  void show(const EvaluationCounts& counts);  ///< after each simulation
  void end();                                 ///< ends the rewritten line

 private:
  void rewrite(bool now);
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
  std::string last_;
};

}  // namespace pastefit
