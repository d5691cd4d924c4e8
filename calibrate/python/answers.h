#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/search/candidate_queue.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit::python {

/// What somebody else's simulator answered to a candidate.
struct EngineAnswer {
  std::size_t candidate = 0;
  Readings readings;                 ///< under their names in the study, all finite
  std::optional<std::string> error;  ///< why there are none
};

/// Why an answer is a failed simulation; nothing if it has its readings.
std::optional<Failure> failure_of(const EngineAnswer& answer);

/// What is asked, and every answer, kept before it is used.
class Answers {
 public:
  virtual ~Answers() = default;
  virtual const Scoring& scoring() const = 0;
  virtual const SearchOptions& options() const = 0;
  /// The free parameters, in the order of a point's coordinates.
  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// That an answer has to give.
  const std::vector<std::string>& readings() const { return readings_; }
  /// What is known from earlier inputs, each point on one packing.
  virtual std::vector<Response> earlier() const { return {}; }

  virtual std::optional<Evaluation> find(const Candidate& candidate) const = 0;
  /// Error: it could not be kept.
  virtual Result<Evaluation> keep(const Candidate& candidate, const EngineAnswer& answer) = 0;

  virtual TrainingData evidence(std::span<const Response> history) const = 0;
  /// Nothing if the test is none that a card can hold.
  virtual std::optional<Card> card(const Calibration& found, const EvaluationCounts& counts) const = 0;
  /// As `evaluations_json`.
  virtual nlohmann::ordered_json evaluations() const = 0;

 protected:
  Answers(const std::vector<Parameter>& parameters, const std::vector<StudyReading>& readings);

 private:
  std::vector<Parameter> parameters_;
  std::vector<std::string> readings_;
};

/// The answers to a study, in the store of this file. `engine`: name and version of what simulates; answers of another
/// one are no answers.
/// Errors: what keeps the study from being searched; the store is of another engine or study.
Result<std::unique_ptr<Answers>> answers_to_study(std::shared_ptr<const Study> study, const std::string& study_file,
                                                  const std::string& file, const std::string& engine);

}  // namespace pastefit::python
