#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <thread>

#include "calibrate/inference/inference.h"
#include "calibrate/search/calibration.h"
#include "calibrate/search/candidate_queue.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit::python {

/// `examine` with simulations that run in another engine: it waits in a thread of its own, and its candidates are
/// suggested and answered by `queue`, as those of a search are.
class StoredExamination {
 public:
  /// Requirements: those of `examine`; study, store and calibration outlive it.
  StoredExamination(const Study& study, const Store& store, const Calibration& found, int simulations);
  StoredExamination(const StoredExamination&) = delete;
  StoredExamination& operator=(const StoredExamination&) = delete;
  ~StoredExamination();

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
