#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/reading_scoring.h"
#include "calibrate/python/answers.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

/// What a study is for tests that pastefit does not know: parameters and readings of any name, and how to search.
struct CustomProblem {
  std::string title;
  std::vector<Parameter> parameters;   ///< all free
  std::vector<StudyReading> readings;  ///< with their tolerances
  SearchOptions search;
  std::string content;  ///< as JSON text
};

/// Reads {"title", "parameters": {NAME: {"free", "scale", "prior"}}, "measurements": {NAME: {"value",
/// "standard_deviation", "repeats"}}, "tolerances": {NAME: ...}, "weights": {NAME: ...}, "search"}, with the meaning
/// that these have in laboratory and study files. A reading without a tolerance has its standard deviation as one.
/// Errors: every fault, each with its place; a name that candidates, answers or evaluations have themselves (`own`).
Result<CustomProblem> problem_from_json(const nlohmann::json& document, std::span<const std::string> own);

/// The answers to a problem, in a store.
class ProblemAnswers : public Answers {
 public:
  /// Errors: those of `Store::open`; the file holds answers to another problem.
  static Result<std::unique_ptr<Answers>> open(CustomProblem problem, const std::string& file,
                                               const std::string& engine);

  const Scoring& scoring() const override { return scoring_; }
  const SearchOptions& options() const override { return problem_.search; }
  std::optional<Evaluation> find(const Candidate& candidate) const override;
  Result<Evaluation> keep(const Candidate& candidate, const EngineAnswer& answer) override;
  TrainingData evidence(std::span<const Response> history) const override;
  std::optional<Card> card(const Calibration&, const EvaluationCounts&) const override { return std::nullopt; }
  nlohmann::ordered_json evaluations() const override;

 private:
  /// A candidate that failed is off by the measured value, or ten standard deviations if that is more.
  class ProblemScoring : public ReadingScoring {
   public:
    using ReadingScoring::ReadingScoring;
    int simulations_each() const override { return 1; }

   protected:
    double largest_error(const StudyReading& reading) const override;
  };

  ProblemAnswers(CustomProblem problem, Store store);
  bool is_answer(const StoredEvaluation& kept) const;
  Evaluation evaluation_of(const StoredEvaluation& kept) const;

  const CustomProblem problem_;
  Store store_;
  const ProblemScoring scoring_;
};

}  // namespace pastefit::python
