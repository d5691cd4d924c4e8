#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <thread>

#include "calibrate/inference/inference.h"
#include "calibrate/python/answers.h"
#include "calibrate/search/calibration.h"
#include "calibrate/search/candidate_queue.h"

namespace pastefit::python {

/// `examine` with simulations that run in another engine: it waits in a thread of its own, and its candidates are
/// suggested and answered by `queue`, as those of a search are.
class AskedExamination {
 public:
  /// Requirements: those of `examine`; answers and calibration outlive it.
  AskedExamination(const Answers& answers, const Calibration& found, int simulations);
  AskedExamination(const AskedExamination&) = delete;
  AskedExamination& operator=(const AskedExamination&) = delete;
  ~AskedExamination();

  CandidateQueue& queue();
  /// Requirement: the queue has finished. Throws what ended the examination if that was an error.
  const std::optional<Inference>& inference() const;

 private:
  class AskingObjective;
  std::unique_ptr<AskingObjective> objective_;
  std::optional<Inference> inference_;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace pastefit::python
