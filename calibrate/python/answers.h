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

/// Result of an external simulator for a candidate.
struct EngineAnswer {
  std::size_t candidate = 0;
  Readings readings;                 ///< by name in the study, all finite
  std::optional<std::string> error;  ///< reason why there are none
};

/// Failure of an answer; nothing if it has readings.
std::optional<Failure> failure_of(const EngineAnswer& answer);

/// Problem of a search, and storage of its answers; every answer is stored before it is used.
class Answers {
 public:
  virtual ~Answers() = default;
  virtual const Scoring& scoring() const = 0;
  virtual const SearchOptions& options() const = 0;
  /// Free parameters in the order of a point's coordinates.
  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// Names of the required readings.
  const std::vector<std::string>& readings() const { return readings_; }
  /// Responses from earlier inputs; each point has a single packing.
  virtual std::vector<Response> earlier() const { return {}; }

  virtual std::optional<Evaluation> find(const Candidate& candidate) const = 0;
  /// Error: the answer cannot be stored.
  virtual Result<Evaluation> keep(const Candidate& candidate, const EngineAnswer& answer) = 0;

  virtual TrainingData evidence(std::span<const Response> history) const = 0;
  /// Nothing if a card cannot represent the test.
  virtual std::optional<Card> card(const Calibration& found, const EvaluationCounts& counts) const = 0;
  /// Same format as `evaluations_json`.
  virtual nlohmann::ordered_json evaluations() const = 0;

 protected:
  Answers(const std::vector<Parameter>& parameters, const std::vector<StudyReading>& readings);

 private:
  std::vector<Parameter> parameters_;
  std::vector<std::string> readings_;
};

/// Answers to a study, stored in `file`. `engine`: name and version of the simulator; answers of other engines are not
/// used. Errors: the study cannot be searched; the store belongs to another engine or study.
Result<std::unique_ptr<Answers>> answers_to_study(std::shared_ptr<const Study> study, const std::string& study_file,
                                                  const std::string& file, const std::string& engine);

}  // namespace pastefit::python
