#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/python/answers.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit::python {

/// The answers to a study, in a store.
class StudyAnswers : public Answers {
 public:
  /// `engine`: name and version of what simulates; answers of another one are no answers. `file`: of the store.
  /// Errors: what keeps the study from being searched; the store is of another engine or study.
  static Result<std::unique_ptr<Answers>> open(std::shared_ptr<const Study> study, const std::string& study_file,
                                               const std::string& file, const std::string& engine);

  const Scoring& scoring() const override { return scoring_; }
  const SearchOptions& options() const override { return study_->search; }
  std::vector<Parameter> parameters() const override;
  std::vector<std::string> readings() const override;
  std::vector<Response> earlier() const override;
  std::optional<Evaluation> find(const Candidate& candidate) const override;
  Result<Evaluation> keep(const Candidate& candidate, const EngineAnswer& answer) override;
  TrainingData evidence(std::span<const Response> history) const override;
  std::optional<Card> card(const Calibration& found, const EvaluationCounts& counts) const override;
  nlohmann::ordered_json evaluations() const override;

 private:
  StudyAnswers(std::shared_ptr<const Study> study, std::string study_file, Store store);
  StoredEvaluation evaluation_of(const Candidate& candidate, const EngineAnswer& answer, std::size_t test) const;
  /// One for each fitted test.
  Evaluation merged_evaluation(const UnitPoint& point, const std::vector<StoredEvaluation>& evaluations) const;

  const std::shared_ptr<const Study> study_;
  const std::string study_file_;
  Store store_;
  const StudyScoring scoring_;
};

}  // namespace pastefit::python
