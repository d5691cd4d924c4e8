#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "calibrate/answers.h"
#include "calibrate/card/card.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/inference/examination.h"
#include "calibrate/inference/inference.h"
#include "calibrate/search/search.h"

namespace pastefit {

struct CalibrationResult {
  Calibration search;
  EvaluationCounts counts;
  std::optional<Card> card;            ///< none if no candidate could be simulated
  std::optional<Inference> inference;  ///< none if the readings are out of reach, or after an interruption
};

/// Calibration with an ask-and-tell interface, from the first candidate to the card; the simulations may run anywhere:
///
///     StudyAnswers answers(study, store, "study.json");
///     Calibrator calibrator(answers);
///     while (!calibrator.finished())
///       for (const Simulation& one : calibrator.suggest(n)) {
///         StoredEvaluation evaluation = answers.unanswered(one);
///         enter(evaluation, simulate(test_of(one), ...), cutoff_of(one));  // anywhere, in any order
///         calibrator.ingest(one, evaluation);
///       }
///     calibrator.result();
///
/// Stages: the search (`Search`); of a confirmed material the held-out tests, on the packings of its confirmation, and
/// the effects of unstated conditions; the examination of which other materials fit (`Examination`); the card. A stage
/// begins when the one before has all its answers. All of this together uses at most `budget_simulations`. Stored
/// evaluations are not asked for again, so an interrupted calibration continues where it stopped; the result depends on
/// the answers only, not on their order. No call blocks, and no thread is started; one caller at a time. Requirements:
/// the options are valid (`validate`, `calibrate.h`); `answers` outlive the calibrator.
class Calibrator {
 public:
  explicit Calibrator(Answers& answers, std::function<void(const Progress&)> progress = {});

  /// Simulations of at most `count` new candidates, one for each of its tests that is not stored yet; none if answers
  /// are needed first, or at the end.
  std::vector<Simulation> suggest(std::size_t count);
  /// Stores an evaluation and uses it. Known ones are ignored. Error: it cannot be stored.
  Faults ingest(const Simulation& simulation, const StoredEvaluation& evaluation);
  /// Ends the calibration with the best result so far. `infers`: still infers from the simulations so far, which takes
  /// some seconds; the examination does in any case, once the search has ended.
  void stop(bool infers = false);
  bool finished() const { return stage_ == Stage::over; }
  const EvaluationCounts& counts() const { return counts_; }
  /// Best material so far, on all packings of its fitted tests; no point if none.
  const Response& best() const { return best_; }
  /// Requirement: it has finished.
  CalibrationResult result() const;

 private:
  enum class Stage { search, hold_outs, conditions, examination, over };
  /// A candidate, with its evaluations as far as they are known.
  struct Asked {
    std::vector<Simulation> simulations;
    std::vector<StoredEvaluation> evaluations;  // one for each simulation; without a key: not known yet
    bool counts = true;                         // in the budget
    bool is_answered() const;
  };
  /// Candidates at both ends of a condition's range: test by test, each on the same packings.
  struct AskedCondition {
    UnstatedCondition condition;
    std::vector<std::size_t> lower, upper;
  };

  std::optional<std::size_t> next_candidate();
  std::vector<Simulation> unknown_simulations_of(std::size_t number);
  void enter(std::size_t number, std::size_t place, StoredEvaluation evaluation, int EvaluationCounts::*counter);
  void tell(std::size_t number);
  void note_material(Evaluation evaluation);
  Response response_of(const Asked& asked) const;

  /// Begins the next stages, as far as the answers reach.
  void advance();
  void begin_hold_outs();
  void begin_conditions();
  void begin_examination();
  void go_on_examining();
  std::size_t ask(std::vector<Simulation> simulations);
  std::vector<std::size_t> ask_at(double factor, const UnstatedCondition& condition, std::size_t packings);
  std::vector<ConditionEffect> effects() const;

  Answers& answers_;
  const SearchOptions options_;
  const std::function<void(const Progress&)> progress_;
  Search search_;
  Stage stage_ = Stage::search;
  std::deque<Asked> asked_;           // by number; those of the search first, with the same numbers
  std::deque<std::size_t> open_;      // after the search: not suggested yet
  std::vector<std::size_t> awaited_;  // after the search: by the present stage
  EvaluationCounts counts_;
  std::map<std::vector<double>, std::vector<Evaluation>> materials_;  // by point: evaluations of the fitted tests
  Response best_;
  bool stopped_ = false, infers_ = true;
  Calibration found_;    // by the search
  int points_left_ = 0;  // for the examination
  std::vector<AskedCondition> conditions_;
  std::optional<Examination> examination_;
};

}  // namespace pastefit
