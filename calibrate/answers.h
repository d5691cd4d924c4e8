#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/inference/training_data.h"
#include "calibrate/search/search.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// What is calibrated, and the store of its evaluations. Every evaluation is stored before it is used.
class Answers {
 public:
  virtual ~Answers() = default;
  virtual const Scoring& scoring() const = 0;
  virtual const SearchOptions& options() const = 0;
  /// Free parameters in the order of a point's coordinates.
  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// Names of the measured readings.
  const std::vector<std::string>& readings() const { return readings_; }
  /// The study, if its held-out tests and changed conditions are simulated, too; otherwise null.
  virtual std::shared_ptr<const Study> whole_study() const { return nullptr; }
  /// Responses from earlier inputs; each point has a single packing.
  virtual std::vector<Response> earlier() const { return {}; }

  /// Simulations of a candidate of the search: one for each fitted test.
  virtual std::vector<Simulation> simulations_of(const Candidate& candidate) const = 0;
  virtual StoredEvaluation unanswered(const Simulation& simulation) const = 0;
  virtual std::optional<StoredEvaluation> find(const Simulation& simulation) const = 0;
  /// Error: it cannot be stored.
  Faults add(const StoredEvaluation& evaluation) { return store_.add(evaluation); }
  /// Why an evaluation cannot be used; nothing if it can.
  virtual std::optional<Failure> failure_of(const Simulation& simulation, const StoredEvaluation& evaluation) const = 0;
  /// Merges the evaluations of a candidate, one for each of its simulations.
  virtual Evaluation evaluation_of(std::span<const Simulation> simulations,
                                   std::span<const StoredEvaluation> evaluations) const = 0;

  virtual TrainingData evidence(std::span<const Response> history) const = 0;
  /// Nothing if a card cannot represent the test.
  virtual std::optional<Card> card(const Calibration& found, const EvaluationCounts& counts) const = 0;

 protected:
  Answers(const std::vector<Parameter>& parameters, const std::vector<StudyReading>& readings, Store& store);
  const Store& store() const { return store_; }

 private:
  std::vector<Parameter> parameters_;
  std::vector<std::string> readings_;
  Store& store_;
};

/// Simulations of the confirmed material in the held-out tests, on the packings of its confirmation.
int hold_out_simulations(const Study& study);

/// Search options without these simulations, which follow the search.
SearchOptions options_of_the_search(const Study& study);

enum class Simulates {
  every_test,   ///< held-out ones, coarse grains and changed conditions, too
  fitted_tests  ///< by a program that knows a candidate's parameters and seed only
};

/// Answers to a study. Requirement: `store` outlives them. `study_file`: name for the card's provenance.
class StudyAnswers : public Answers {
 public:
  StudyAnswers(std::shared_ptr<const Study> study, Store& store, std::string study_file,
               Simulates simulates = Simulates::every_test);

  const Scoring& scoring() const override { return scoring_; }
  const SearchOptions& options() const override { return study_->search; }
  std::shared_ptr<const Study> whole_study() const override { return simulates_all_ ? study_ : nullptr; }
  std::vector<Response> earlier() const override;
  std::vector<Simulation> simulations_of(const Candidate& candidate) const override;
  StoredEvaluation unanswered(const Simulation& simulation) const override;
  std::optional<StoredEvaluation> find(const Simulation& simulation) const override;
  std::optional<Failure> failure_of(const Simulation& simulation, const StoredEvaluation& evaluation) const override;
  Evaluation evaluation_of(std::span<const Simulation> simulations,
                           std::span<const StoredEvaluation> evaluations) const override;
  TrainingData evidence(std::span<const Response> history) const override;
  std::optional<Card> card(const Calibration& found, const EvaluationCounts& counts) const override;

 private:
  const std::shared_ptr<const Study> study_, coarse_study_;
  const std::string study_file_;
  const bool simulates_all_;
  const StudyScoring scoring_, coarse_scoring_;
};

}  // namespace pastefit
