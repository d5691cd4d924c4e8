#include "calibrate/python/answers.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/card/calibration_card.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/python/module.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

std::optional<Failure> failure_of(const EngineAnswer& answer) {
  if (!answer.error) return std::nullopt;
  Failure failure;
  failure.reason = FailureReason::engine_failed;
  failure.message = *answer.error;
  return failure;
}

Answers::Answers(const std::vector<Parameter>& parameters, const std::vector<StudyReading>& readings) {
  for (const Parameter& one : parameters)
    if (one.free) parameters_.push_back(one);
  for (const StudyReading& one : readings) readings_.push_back(one.name);
}

namespace {

/// Readings of one test under its own names.
Readings readings_of_test(const StudyTest& test, const Readings& of_study) {
  const std::string before = reading_name(test, "");
  Readings out;
  for (const auto& [name, value] : of_study.all())
    if (name.starts_with(before)) out.set(std::string_view(name).substr(before.size()), value);
  return out;
}

/// The answers to a study.
class StudyAnswers : public Answers {
 public:
  StudyAnswers(std::shared_ptr<const Study> study, std::string study_file, Store store)
      : Answers(study->parameters, readings_of(*study)),
        study_(std::move(study)),
        study_file_(std::move(study_file)),
        store_(std::move(store)),
        scoring_(*study_) {}

  const Scoring& scoring() const override { return scoring_; }
  const SearchOptions& options() const override { return study_->search; }

  std::vector<Response> earlier() const override {
    std::vector<Response> responses;
    for (const StoredEvaluation& known : earlier_of(*study_, store_)) {
      const UnitPoint point =
          Eigen::Map<const Eigen::VectorXd>(known.point.data(), static_cast<Eigen::Index>(known.point.size()));
      responses.push_back(scoring_.response_of({scoring_.evaluation_of(point, known)}));
    }
    return responses;
  }

  std::optional<Evaluation> find(const Candidate& candidate) const override {
    const auto values = values_at(*study_, coordinates(candidate.point));
    std::vector<StoredEvaluation> known;
    for (const std::size_t test : scoring_.fitted_tests()) {
      auto found = store_.find(key_of(*study_, test, values, candidate.packing, store_.identity().program));
      if (!found) return std::nullopt;
      known.push_back(std::move(*found));
    }
    return merged_evaluation(candidate.point, known);
  }

  Result<Evaluation> keep(const Candidate& candidate, const EngineAnswer& answer) override {
    std::vector<StoredEvaluation> evaluations;
    for (const std::size_t test : scoring_.fitted_tests()) {
      evaluations.push_back(evaluation_of(candidate, answer, test));
      if (auto faults = store_.add(evaluations.back()); !faults.empty()) return faults;
    }
    return merged_evaluation(candidate.point, evaluations);
  }

  TrainingData evidence(std::span<const Response> history) const override {
    return training_data_of(*study_, record_of(*study_, store_, history));
  }

  std::optional<Card> card(const Calibration& found, const EvaluationCounts& counts) const override {
    return card_of(*study_, found, study_->search, baselines_of(*study_, shown_of(found), store_), counts, study_file_);
  }

  nlohmann::ordered_json evaluations() const override { return evaluations_json(store_); }

 private:
  StoredEvaluation evaluation_of(const Candidate& candidate, const EngineAnswer& answer, std::size_t test) const {
    StoredEvaluation out;
    out.values = values_at(*study_, coordinates(candidate.point));
    out.key = key_of(*study_, test, out.values, candidate.packing, store_.identity().program);
    out.point.assign(candidate.point.begin(), candidate.point.end());
    out.packing = candidate.packing;
    out.failure = python::failure_of(answer);
    if (!out.failure) out.readings = readings_of_test(study_->tests[test], answer.readings);
    return out;
  }

  /// `evaluations`: one for each fitted test.
  Evaluation merged_evaluation(const UnitPoint& point, const std::vector<StoredEvaluation>& evaluations) const {
    Evaluation out = scoring_.evaluation_of(point, merged(*study_, scoring_.fitted_tests(), evaluations));
    out.simulations = scoring_.simulations_each();
    return out;
  }

  const std::shared_ptr<const Study> study_;
  const std::string study_file_;
  Store store_;
  const StudyScoring scoring_;
};

}  // namespace

Result<std::unique_ptr<Answers>> answers_to_study(std::shared_ptr<const Study> study, const std::string& study_file,
                                                  const std::string& file, const std::string& engine) {
  if (auto faults = validate(*study, CalibrateOptions{}); !faults.empty()) return faults;
  auto store = Store::open(file, {engine, inputs_of(*study)});
  if (!store.ok()) return store.faults();
  if (auto faults = strangers_in(*study, store.value(), file); !faults.empty()) return faults;
  return std::unique_ptr<Answers>(
      std::make_unique<StudyAnswers>(std::move(study), study_file, std::move(store).value()));
}

}  // namespace pastefit::python
