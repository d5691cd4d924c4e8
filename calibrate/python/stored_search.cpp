#include "calibrate/python/stored_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibrate/card/calibration_card.h"
#include "calibrate/inference/description.h"
#include "calibrate/search/record.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

Result<std::unique_ptr<StoredSearch>> StoredSearch::open(std::shared_ptr<const Study> study,
                                                         const std::string& study_file, const std::string& file,
                                                         const std::string& engine) {
  if (auto faults = validate(*study, CalibrateOptions{}); !faults.empty()) return faults;
  auto store = Store::open(file, {engine, inputs_of(*study)});
  if (!store.ok()) return store.faults();
  if (auto faults = strangers_in(*study, store.value(), file); !faults.empty()) return faults;
  return std::unique_ptr<StoredSearch>(new StoredSearch(std::move(study), study_file, std::move(store).value()));
}

StoredSearch::StoredSearch(std::shared_ptr<const Study> study, std::string study_file, Store store)
    : study_(std::move(study)), study_file_(std::move(study_file)), store_(std::move(store)), scoring_(*study_) {
  SearchStart start;
  start.simulations = study_->search.budget_simulations;
  for (const StoredEvaluation& known : earlier_of(*study_, store_)) {
    const UnitPoint point =
        Eigen::Map<const Eigen::VectorXd>(known.point.data(), static_cast<Eigen::Index>(known.point.size()));
    start.earlier.push_back(scoring_.response_of({scoring_.evaluation_of(point, known)}));
  }
  for (const StudyReading& reading : readings_of(*study_)) start.readings.push_back(reading.name);
  for (const Parameter& parameter : study_->parameters)
    if (parameter.free) start.parameters.push_back(parameter.name);
  search_ = std::make_unique<Search>(scoring_, study_->search, std::move(start), [this](const Progress& progress) {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    phase_ = progress.phase;
    progress_.phase = {};
  });
}

Progress StoredSearch::progress(std::string& phase) const {
  const std::lock_guard lock(mutex_);
  phase = phase_;
  return progress_;
}

std::vector<Candidate> StoredSearch::suggest(std::size_t count) {
  for (;;) {
    auto candidates = next(count);
    const bool any = !candidates.empty();
    std::erase_if(candidates, [this](const Candidate& one) { return answered_by_store(one); });
    for (const Candidate& one : candidates) asked_.emplace(one.number, one);
    if (!any || !candidates.empty()) return candidates;
  }
}

std::vector<Candidate> StoredSearch::next(std::size_t count) {
  auto candidates = search_->suggest(count);
  for (const Candidate& one : candidates) asked_by_the_search_ = std::max(asked_by_the_search_, one.number + 1);
  if (!candidates.empty() || !begin_examination()) return candidates;
  candidates = examination_->queue().suggest(count);
  for (Candidate& one : candidates) one.number += asked_by_the_search_;
  return candidates;
}

/// False as long as the search goes on, and if there is nothing to examine.
bool StoredSearch::begin_examination() {
  if (examination_) return true;
  if (!search_->finished() || stopped_) return false;
  found_ = search_->result();
  const bool any = found_.best.point.size() > 0 && !found_.best.failed;
  if (!any || found_.status == CalibrationStatus::out_of_reach) return false;
  const int left = study_->search.budget_simulations - counts_.simulated - counts_.answered;
  examination_ = std::make_unique<StoredExamination>(*study_, store_, found_, std::max(0, left));
  return true;
}

void StoredSearch::stop() {
  stopped_ = true;
  search_->stop();
  if (examination_) examination_->queue().stop();
}

bool StoredSearch::finished() {
  return search_->finished() && (!begin_examination() || examination_->queue().finished());
}

bool StoredSearch::answered_by_store(const Candidate& candidate) {
  const auto values = values_at(*study_, coordinates(candidate.point));
  std::vector<StoredEvaluation> known;
  for (const std::size_t test : scoring_.fitted_tests()) {
    auto found = store_.find(key_of(*study_, test, values, candidate.packing, store_.identity().program));
    if (!found) return false;
    known.push_back(std::move(*found));
  }
  counts_.answered += static_cast<int>(known.size());
  tell(candidate, known);
  return true;
}

/// Readings of a test, under the names that it has for them.
static Observables readings_of_test(const StudyTest& test, const Observables& of_study) {
  const std::string before = reading_name(test, "");
  Observables out;
  for (const auto& [name, value] : of_study.all())
    if (name.starts_with(before)) out.set(std::string_view(name).substr(before.size()), value);
  return out;
}

StoredEvaluation StoredSearch::evaluation_of(const Candidate& candidate, const EngineAnswer& answer,
                                             std::size_t test) const {
  StoredEvaluation out;
  out.values = values_at(*study_, coordinates(candidate.point));
  out.key = key_of(*study_, test, out.values, candidate.packing, store_.identity().program);
  out.point.assign(candidate.point.begin(), candidate.point.end());
  out.packing = candidate.packing;
  std::string why = answer.error.value_or("");
  for (const StudyReading& reading : readings_of(*study_))
    if (!answer.error && !std::isfinite(answer.readings.find(reading.name).value()))
      why = "The simulator gave no number for " + reading.name + ".";
  if (answer.error || !why.empty()) {
    out.failure.emplace().reason = FailureReason::engine_failed;
    out.failure->message = why.empty() ? "The simulator failed." : why;
  } else {
    out.observables = readings_of_test(study_->tests[test], answer.readings);
  }
  return out;
}

Faults StoredSearch::faults_of(const EngineAnswer& answer, std::size_t place) const {
  const std::string where = "results[" + std::to_string(place) + "]";
  if (!asked_.contains(answer.candidate))
    return {{where, "answers candidate " + std::to_string(answer.candidate) + ", which nobody asked for",
             "the \"_id\" of a candidate that suggest() gave"}};
  Faults faults;
  if (answer.error) return faults;
  for (const StudyReading& reading : readings_of(*study_))
    if (!answer.readings.find(reading.name))
      faults.push_back({where, "has no \"" + reading.name + "\", which the laboratory measured",
                        "the number, NaN if there is none, or \"error\": why the simulation failed"});
  return faults;
}

Faults StoredSearch::ingest(const std::vector<EngineAnswer>& answers) {
  Faults faults;
  for (std::size_t i = 0; i < answers.size(); ++i)
    for (Fault& fault : faults_of(answers[i], i)) faults.push_back(std::move(fault));
  if (!faults.empty()) return faults;
  for (const EngineAnswer& answer : answers) {
    const Candidate& candidate = asked_.at(answer.candidate);
    if (answered_by_store(candidate)) continue;  // twice
    std::vector<StoredEvaluation> evaluations;
    for (const std::size_t test : scoring_.fitted_tests()) {
      evaluations.push_back(evaluation_of(candidate, answer, test));
      if (faults = store_.add(evaluations.back()); !faults.empty()) return faults;
    }
    counts_.simulated += static_cast<int>(evaluations.size());
    tell(candidate, evaluations);
  }
  return {};
}

void StoredSearch::tell(const Candidate& candidate, const std::vector<StoredEvaluation>& evaluations) {
  for (const StoredEvaluation& one : evaluations)
    if (one.failure) ++counts_.failures[one.failure->reason];
  Evaluation evaluation =
      scoring_.evaluation_of(candidate.point, merged(*study_, scoring_.fitted_tests(), evaluations));
  evaluation.simulations = scoring_.simulations_each();
  CandidateResult result{candidate.number, std::move(evaluation)};
  if (!examination_) return search_->ingest({&result, 1});
  if (result.candidate < asked_by_the_search_) return;  // it came too late
  result.candidate -= asked_by_the_search_;
  examination_->queue().ingest({&result, 1});
}

CalibrationResult StoredSearch::result() {
  CalibrationResult result;
  result.search = search_->result();
  result.counts = counts_;
  const Calibration& found = result.search;
  if (found.best.point.size() == 0 || found.best.failed) return result;
  result.card =
      card_of(*study_, found, study_->search, baselines_of(*study_, shown_of(found), store_), counts_, study_file_);
  if (!examination_) return result;
  result.inference = examination_->inference();
  if (result.inference) result.card->inference = card_inference(*result.inference);
  return result;
}

}  // namespace pastefit::python
