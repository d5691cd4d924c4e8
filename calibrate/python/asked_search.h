#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/calibrator.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "core/step/run.h"

namespace pastefit::python {

/// Result of an external simulator for a candidate.
struct EngineAnswer {
  std::size_t candidate = 0;
  Outcome outcome;  ///< readings by name in the study, all finite, or the reason why there are none
};

/// Calibration with an external simulator, which answers a candidate with all its readings at once. Texts are JSON.
class AskedSearch {
 public:
  /// `table`: the evaluations of a store, as `evaluations_json`.
  using Table = std::function<nlohmann::ordered_json(const Store&)>;
  AskedSearch(std::unique_ptr<Store> store, std::unique_ptr<Answers> answers, Table table);

  /// [{"_id", "seed", "variables", "purpose"}, ...]
  std::string suggest(std::size_t count);
  /// Takes answers, [{"_id", "readings": {...}}, or {"_id", "error"}, ...]. Refused: an answer to an unknown candidate,
  /// or without a measured reading (nothing is taken then); an answer that cannot be stored.
  void ingest(const std::string& answers);
  /// Ends the search with the best result so far, without examination.
  void stop() { calibrator_.stop(); }
  bool finished() const { return calibrator_.finished(); }

  /// As `result_json`; without a card, also "parameters" and "readings" of the reported candidate. Requirement:
  /// `finished()`.
  std::string result() const;
  std::string evaluations() const { return table_(*store_).dump(); }
  std::string progress() const;

 private:
  Faults faults_of(const EngineAnswer& answer, std::size_t place) const;

  const std::unique_ptr<Store> store_;
  const std::unique_ptr<Answers> answers_;
  const Table table_;
  std::map<std::size_t, std::vector<Simulation>> asked_;  // simulations of the suggested candidates
  mutable std::mutex mutex_;                              // guards what follows
  Progress progress_;
  Calibrator calibrator_;  // last: reports progress
};

/// Answers to a study, stored in `file`. `engine`: name and version of the simulator; answers of other engines are not
/// used. Refused: the study cannot be searched; the store belongs to another engine or study.
std::shared_ptr<AskedSearch> search_of_study(std::shared_ptr<Study> study, const std::string& study_file,
                                             const std::string& file, const std::string& engine);

/// Calibration problem for tests unknown to pastefit: arbitrary parameters and readings, and search options.
struct CustomProblem {
  std::string title;
  std::vector<Parameter> parameters;   ///< all free
  std::vector<StudyReading> readings;  ///< with their tolerances
  SearchOptions search;
  std::string content;  ///< as JSON text
};

/// Reads {"title", "parameters": {NAME: {"free", "scale", "prior"}}, "measurements": {NAME: {"value",
/// "standard_deviation", "repeats"}}, "tolerances": {NAME: ...}, "weights": {NAME: ...}, "search"}, as in laboratory
/// and study files. Default tolerance: the standard deviation. Refused: every fault, with its place; names reserved by
/// candidates, answers or evaluations (`own`).
CustomProblem problem_from_json(const std::string& text, const std::vector<std::string>& own);

/// Answers to a problem, stored in `file`. Refused: the errors of `Store::open`; the store belongs to another problem.
std::shared_ptr<AskedSearch> search_of_problem(CustomProblem problem, const std::string& file,
                                               const std::string& engine);

}  // namespace pastefit::python
