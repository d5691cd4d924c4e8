#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/python/answers.h"
#include "calibrate/python/custom_problem.h"
#include "calibrate/search/reading_scoring.h"

namespace pastefit::python {

/// The answers to a problem, in a file of a JSON object for each line: first the problem and the engine, then answers.
class ProblemAnswers : public Answers {
 public:
  /// Errors: the file cannot be read or written, or is of another problem or engine.
  static Result<std::unique_ptr<Answers>> open(CustomProblem problem, const std::string& file,
                                               const std::string& engine);

  const Scoring& scoring() const override { return scoring_; }
  const SearchOptions& options() const override { return problem_.search; }
  std::vector<Parameter> parameters() const override { return problem_.parameters; }
  std::vector<std::string> readings() const override;
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
  using Key = std::pair<std::vector<double>, std::uint64_t>;  // point and packing

  ProblemAnswers(CustomProblem problem, std::string file);
  Faults read(const std::string& first_line);
  Faults append(const std::string& line) const;
  bool is_answer(const nlohmann::json& kept) const;
  void take(const nlohmann::json& kept);

  const CustomProblem problem_;
  const std::string file_;
  const ProblemScoring scoring_;
  std::map<Key, Evaluation> known_;
  std::vector<Key> order_;
};

}  // namespace pastefit::python
