#include "calibrate/browser/calibration_session.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/refusal.h"
#include "calibrate/base/text.h"
#include "calibrate/calibrate.h"
#include "calibrate/inference/description.h"
#include "calibrate/laboratory/engine.h"
#include "calibrate/report/page.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/program.h"
#include "calibrate/study/tests.h"

namespace pastefit::browser {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr const char *kLabFile = "lab.json", *kStudyFile = "study.json";

/// Writes both files where the program would have them, and reads them as it does: the same faults, with their places.
Study requested_study(const json& request) {
  refuse(write_atomically(kLabFile, request.at("lab").get<std::string>()));
  refuse(write_atomically(kStudyFile, request.at("study").get<std::string>()));
  StudyChanges changes;
  changes.of_study = [](json& study) {
    if (study.is_object() && study.contains("lab") && study["lab"].is_string()) study["lab"] = kLabFile;
  };
  Study study = value_or_throw(read_study(kStudyFile, changes));
  if (const auto seed = request.find("seed"); seed != request.end() && !seed->is_null())
    study.search.seed = seed->get<std::uint64_t>();
  if (const auto budget = request.find("budget"); budget != request.end() && !budget->is_null())
    study.search.budget_simulations = budget->get<int>();
  refuse(in_file(validate(study, 1), kStudyFile));
  return study;
}

std::unique_ptr<Store> new_store(const Study& study) {
  std::error_code none_there;
  std::filesystem::remove(kStore, none_there);
  return std::make_unique<Store>(value_or_throw(Store::open(kStore, {program_identity(), inputs_of(study)})));
}

RunOptions run_options(const Simulation& simulation) {
  RunOptions options;
  options.steps.energy_balance = !simulation.may_end_early;
  options.cutoff = cutoff_of(simulation);
  return options;
}

/// Simulations of one apparatus and its grains, on one packing and with the same preparation, share a filled mould.
std::string packing_name(const Simulation& simulation, const Test& test) {
  const Test& without_material = simulation.study->tests.at(simulation.test).lab.test;
  return evaluation_key(std::to_string(simulation.packing) + " " + preparation_key(test), without_material);
}

}  // namespace

CalibrationSession::CalibrationSession(const json& request)
    : study_(std::make_shared<const Study>(requested_study(request))), store_(new_store(*study_)) {
  answers_ = std::make_unique<StudyAnswers>(study_, *store_, kStudyFile);
  calibrator_ = std::make_unique<Calibrator>(*answers_, [this](const Progress& progress) {
    phase_ = progress.phase;
    if (!progress.note.empty()) note_ = progress.note;
  });
  if (const auto stored = request.find("stored"); stored != request.end() && stored->is_array())
    for (const json& record : *stored)
      if (record.value("program", "") == program_identity())
        stored_[record.at("task").get<std::string>()] = record.at("answer").get<std::string>();
}

ordered_json CalibrationSession::description() const {
  return {{"title", study_->title}, {"budget", study_->search.budget_simulations}};
}

ordered_json CalibrationSession::suggest(std::size_t count) {
  ordered_json tasks = ordered_json::array();
  for (const std::size_t id : std::exchange(given_back_, {})) tasks.push_back({{"id", id}, {"task", open_[id].task}});
  while (tasks.size() < count && !calibrator_->finished()) {
    const auto simulations = calibrator_->suggest(count - tasks.size());
    if (simulations.empty()) break;
    for (const Simulation& one : simulations) {
      const Test test = test_of(one);
      std::string task = task_text(test, run_options(one), packing_name(one, test));
      if (is_known(one, task)) continue;
      tasks.push_back({{"id", tasks_}, {"task", task}});
      open_[tasks_++] = {one, std::move(task)};
    }
  }
  return tasks;
}

/// Takes the answer of an earlier session, or of a test that cannot be simulated.
bool CalibrationSession::is_known(const Simulation& simulation, const std::string& task) {
  if (auto failure = too_soft(test_of(simulation), run_options(simulation))) {
    TaskAnswer answer;
    answer.outcome.failure = std::move(failure);
    take(simulation, answer);
    return true;
  }
  const auto known = stored_.find(content_hash(task));
  if (known == stored_.end()) return false;
  take(simulation, answer_of_task(known->second));
  return true;
}

ordered_json CalibrationSession::ingest(const json& answers) {
  ordered_json records = ordered_json::array();
  for (const json& given : answers) {
    const auto id = given.at("id").get<std::size_t>();
    const auto open = open_.find(id);
    if (open == open_.end()) continue;  // known already
    const std::string answer = given.contains("error") ? failed_task(given["error"].get<std::string>())
                                                       : given.at("answer").get<std::string>();
    if (answer.empty()) {
      given_back_.push_back(id);
      continue;
    }
    const Open task = std::move(open->second);
    open_.erase(open);
    take(task.simulation, answer_of_task(answer));
    if (!given.contains("error"))
      records.push_back({{"program", program_identity()}, {"task", content_hash(task.task)}, {"answer", answer}});
  }
  return {{"finished", calibrator_->finished()}, {"records", records}};
}

void CalibrationSession::take(const Simulation& simulation, const TaskAnswer& answer) {
  StoredEvaluation evaluation = answers_->unanswered(simulation);
  evaluation.sketch = answer.sketch;
  evaluation.wall_s = evaluation.core_s = answer.wall_s;
  enter(evaluation, answer.outcome, cutoff_of(simulation));
  refuse(calibrator_->ingest(simulation, evaluation), kFailed);
}

ordered_json CalibrationSession::progress() const {
  const EvaluationCounts& counts = calibrator_->counts();
  const Response& best = calibrator_->best();
  ordered_json readings = ordered_json::array();
  const auto of_study = readings_of(*study_);
  for (std::size_t i = 0; i < of_study.size(); ++i) {
    const double simulated = best.point.size() > 0 ? best.readings[static_cast<Eigen::Index>(i)] : std::nan("");
    readings.push_back({{"name", of_study[i].name},
                        {"measured", of_study[i].measurement.value},
                        {"simulated", std::isfinite(simulated) ? ordered_json(simulated) : ordered_json()},
                        {"tolerance", of_study[i].tolerance}});
  }
  return {{"phase", phase_},
          {"simulations", counts.known()},
          {"budget", study_->search.budget_simulations},
          {"best_error", counts.best_error < 0 ? ordered_json() : ordered_json(counts.best_error)},
          {"readings", readings},
          {"why", note_},
          {"sheared", {best.rejected, best.packings.size()}},
          {"finished", calibrator_->finished()}};
}

ordered_json CalibrationSession::result() const {
  const CalibrationResult result = calibrator_->result();
  ordered_json out{{"status", name_of(result.search.status)},
                   {"reason", result.search.reason},
                   {"card", nullptr},
                   {"summary", nullptr}};
  const std::string command = "pastefit report FOLDER";
  if (!result.card) {
    out["report"] = page_of(findings_without_card(*study_, *store_), command);
    return out;
  }
  out["card"] = value_or_throw(readable_text(*result.card));
  out["summary"] = summary_of(*result.card, result.inference ? describe(*result.inference) : "");
  out["report"] = page_of(findings_of(*result.card, *store_, result.inference), command);
  return out;
}

}  // namespace pastefit::browser
