#include "calibrate/python/stored_examination.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "calibrate/inference/examination.h"
#include "calibrate/search/objective.h"
#include "calibrate/search/study_scoring.h"

namespace pastefit::python {

class StoredExamination::AskingObjective : public Objective, public StudyScoring {
 public:
  AskingObjective(const Study& study, int simulations) : StudyScoring(study), queue(*this, simulations, {}) {
    queue.enter("examination");
  }

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override {
    std::vector<Response> responses;
    for (auto& evaluations : queue.evaluate(points, packings, Fidelity::fine, false))
      responses.push_back(response_of(std::move(evaluations)));
    return responses;
  }
  int budget_left() const override { return queue.budget_left(); }
  bool stop_requested() const override { return queue.stop_requested(); }

  CandidateQueue queue;
};

StoredExamination::StoredExamination(const Study& study, const Store& store, const Calibration& found, int simulations)
    : objective_(std::make_unique<AskingObjective>(study, simulations)) {
  thread_ = std::thread([this, &study, &store, &found] {
    try {
      const SearchOptions& search = study.search;
      const int most = std::min(search.examination_simulations, objective_->budget_left());
      inference_ = examine(study, *objective_, store, found, most, search.seed);
    } catch (const CandidateQueue::Closed&) {
    } catch (...) {
      error_ = std::current_exception();
    }
    objective_->queue.finish();
  });
}

StoredExamination::~StoredExamination() {
  objective_->queue.close();
  thread_.join();
}

CandidateQueue& StoredExamination::queue() {
  return objective_->queue;
}

const std::optional<Inference>& StoredExamination::inference() const {
  if (error_) std::rethrow_exception(error_);
  return inference_;
}

}  // namespace pastefit::python
