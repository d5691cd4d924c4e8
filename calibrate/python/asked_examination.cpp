#include "calibrate/python/asked_examination.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "calibrate/inference/examination.h"
#include "calibrate/search/objective.h"

namespace pastefit::python {

/// Asks what is to be simulated, and judges it as the search did.
class AskedExamination::AskingObjective : public Objective {
 public:
  AskingObjective(const Scoring& scoring, int simulations) : queue(scoring, simulations, {}), scoring_(scoring) {
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
  int parameters() const override { return scoring_.parameters(); }
  int residuals() const override { return scoring_.residuals(); }
  Response response_of(std::vector<Evaluation> evaluations) const override {
    return scoring_.response_of(std::move(evaluations));
  }

  CandidateQueue queue;

 private:
  const Scoring& scoring_;
};

AskedExamination::AskedExamination(const Answers& answers, const Calibration& found, int simulations)
    : objective_(std::make_unique<AskingObjective>(answers.scoring(), simulations)) {
  thread_ = std::thread([this, &answers, &found] {
    try {
      const SearchOptions& search = answers.options();
      const int most = std::min(search.examination_simulations, objective_->budget_left());
      const auto evidence = [&](std::span<const Response> history) { return answers.evidence(history); };
      inference_ = examine(evidence, *objective_, found, most, search.seed);
    } catch (const CandidateQueue::Closed&) {
    } catch (...) {
      error_ = std::current_exception();
    }
    objective_->queue.finish();
  });
}

AskedExamination::~AskedExamination() {
  objective_->queue.close();
  thread_.join();
}

CandidateQueue& AskedExamination::queue() {
  return objective_->queue;
}

const std::optional<Inference>& AskedExamination::inference() const {
  if (error_) std::rethrow_exception(error_);
  return inference_;
}

}  // namespace pastefit::python
