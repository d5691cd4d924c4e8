#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibrator.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/store/store.h"

namespace pastefit::browser {

/// A calibration whose simulations other instances of the module run. Its records are what a page keeps, so that a
/// session that was closed goes on: with them the search takes the same path without simulating again.
class CalibrationSession {
 public:
  /// {"lab", "study", "seed", "budget", "stored"}: texts of both files, numbers in place of the study's, and the
  /// records of an earlier session. Files are those of the working folder. Errors: throws `Refusal` of every fault.
  explicit CalibrationSession(const nlohmann::json& request);

  /// {"title", "budget"}
  nlohmann::ordered_json description() const;
  /// Tasks of at most so many candidates, [{"id", "task"}, ...].
  nlohmann::ordered_json suggest(std::size_t count);
  /// [{"id", "answer"}, ...], or in place of the answer "error", why the simulation could not be run. An empty answer
  /// was interrupted: the task is suggested again. Returns {"finished", "records"}: the new ones.
  nlohmann::ordered_json ingest(const nlohmann::json& answers);
  nlohmann::ordered_json progress() const;
  void stop() { calibrator_->stop(); }
  /// {"status", "reason", "card", "summary", "report"}; without a material no card and no summary. Requirement: it has
  /// finished.
  nlohmann::ordered_json result() const;

 private:
  struct Open {
    Simulation simulation;
    std::string task;
  };

  bool is_known(const Simulation& simulation, const std::string& task);
  void take(const Simulation& simulation, const TaskAnswer& answer);

  std::shared_ptr<const Study> study_;
  std::unique_ptr<Store> store_;
  std::unique_ptr<Answers> answers_;
  std::string phase_, note_;
  std::unique_ptr<Calibrator> calibrator_;
  std::map<std::string, std::string> stored_;  // answers of an earlier session, by task
  std::map<std::size_t, Open> open_;           // suggested, by their "id"
  std::vector<std::size_t> given_back_;        // of them: interrupted
  std::size_t tasks_ = 0;
};

}  // namespace pastefit::browser
