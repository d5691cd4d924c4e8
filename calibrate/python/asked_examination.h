#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/inference/examination.h"
#include "calibrate/python/answers.h"
#include "calibrate/search/candidate_queue.h"

namespace pastefit::python {

/// An `Examination` whose simulations run in another engine: its candidates are suggested and answered as those of a
/// search are.
class AskedExamination {
 public:
  /// Requirements: those of `Examination`; answers and calibration outlive it.
  AskedExamination(const Answers& answers, const Calibration& found, int simulations);

  std::vector<Candidate> suggest(std::size_t count) { return queue_.suggest(count); }
  void ingest(const CandidateResult& result);
  void stop();
  bool finished() const { return finished_; }
  /// Requirement: it has finished.
  std::optional<Inference> inference() const { return examination_.result(); }

 private:
  void advance();

  const Scoring& scoring_;
  CandidateQueue queue_;
  Examination examination_;
  std::vector<std::size_t> awaited_;  // candidates, by their numbers
  bool finished_ = false;
};

}  // namespace pastefit::python
