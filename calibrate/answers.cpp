#include "calibrate/answers.h"

#include <utility>

#include "calibrate/card/calibration_card.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/study/tests.h"

namespace pastefit {

Answers::Answers(const std::vector<Parameter>& parameters, const std::vector<StudyReading>& readings, Store& store)
    : store_(store) {
  for (const Parameter& one : parameters)
    if (one.free) parameters_.push_back(one);
  for (const StudyReading& one : readings) readings_.push_back(one.name);
}

int hold_out_simulations(const Study& study) {
  return static_cast<int>(tests_of(study, true).size()) * study.search.confirmation_packings;
}

SearchOptions options_of_the_search(const Study& study) {
  SearchOptions options = study.search;
  options.budget_simulations -= hold_out_simulations(study);
  return options;
}

StudyAnswers::StudyAnswers(std::shared_ptr<const Study> study, Store& store, std::string study_file,
                           Simulates simulates)
    : Answers(study->parameters, readings_of(*study), store),
      study_(std::move(study)),
      coarse_study_(std::make_shared<const Study>(with_coarse_grains(*study_))),
      study_file_(std::move(study_file)),
      simulates_all_(simulates == Simulates::every_test),
      scoring_(*study_),
      coarse_scoring_(*coarse_study_) {}

std::vector<Response> StudyAnswers::earlier() const {
  std::vector<Response> responses;
  for (const StoredEvaluation& known : earlier_of(*study_, store())) {
    const UnitPoint point =
        Eigen::Map<const Eigen::VectorXd>(known.point.data(), static_cast<Eigen::Index>(known.point.size()));
    responses.push_back(scoring_.response_of({scoring_.evaluation_of(point, known)}));
  }
  return responses;
}

std::vector<Simulation> StudyAnswers::simulations_of(const Candidate& candidate) const {
  const auto& study = candidate.fidelity == Fidelity::fine ? study_ : coarse_study_;
  std::vector<Simulation> simulations;
  for (const std::size_t test : scoring_.fitted_tests())
    simulations.push_back({candidate.number, study, test, candidate.point, candidate.packing,
                           simulates_all_ && candidate.may_end_early, candidate.purpose});
  return simulations;
}

StoredEvaluation StudyAnswers::unanswered(const Simulation& simulation) const {
  return pastefit::unanswered(simulation, store().identity().program);
}

std::optional<StoredEvaluation> StudyAnswers::find(const Simulation& simulation) const {
  return pastefit::find(store(), simulation);
}

std::optional<Failure> StudyAnswers::failure_of(const Simulation& simulation,
                                                const StoredEvaluation& evaluation) const {
  return pastefit::failure_of(simulation.study->tests.at(simulation.test), evaluation);
}

Evaluation StudyAnswers::evaluation_of(std::span<const Simulation> simulations,
                                       std::span<const StoredEvaluation> evaluations) const {
  const Simulation& first = simulations.front();
  const StudyScoring& scoring = first.study == coarse_study_ ? coarse_scoring_ : scoring_;
  Evaluation out = scoring.evaluation_of(first.point, merged(*first.study, scoring.fitted_tests(), evaluations));
  out.simulations = scoring.simulations_each();
  return out;
}

TrainingData StudyAnswers::evidence(std::span<const Response> history) const {
  return training_data_of(*study_, record_of(*study_, store(), history));
}

std::optional<Card> StudyAnswers::card(const Calibration& found, const EvaluationCounts& counts) const {
  return card_of(*study_, found, store(), counts, study_file_);
}

}  // namespace pastefit
