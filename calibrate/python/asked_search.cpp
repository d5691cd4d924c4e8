#include "calibrate/python/asked_search.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/card/calibration_card.h"
#include "calibrate/inference/description.h"
#include "calibrate/python/module.h"
#include "calibrate/study/parameters.h"

namespace pastefit::python {

using nlohmann::ordered_json;

/// `Examination` with an external simulator: its candidates are suggested and answered like those of a search.
class AskedExamination {
 public:
  /// Requirements: those of `Examination`; answers and calibration must outlive it.
  AskedExamination(const Answers& answers, const Calibration& found, int simulations)
      : scoring_(answers.scoring()),
        queue_(scoring_, simulations, {}),
        examination_([&answers](std::span<const Response> history) { return answers.evidence(history); }, found,
                     std::min(answers.options().examination_simulations, queue_.budget_left()),
                     answers.options().seed) {
    queue_.enter("examination");
    advance();
  }

  std::vector<Candidate> suggest(std::size_t count) { return queue_.suggest(count); }
  void ingest(const CandidateResult& result) {
    queue_.ingest({&result, 1});
    advance();
  }

  void stop() {
    queue_.stop();
    advance();
  }

  bool finished() const { return finished_; }
  /// Requirement: the examination has finished.
  std::optional<Inference> inference() const { return examination_.result(); }

 private:
  void advance() {
    while (!finished_ && queue_.is_answered(awaited_)) {
      std::vector<Response> responses;
      for (const Evaluation& one : queue_.answers(std::exchange(awaited_, {})))
        responses.push_back(scoring_.response_of({one}));
      examination_.ingest(std::move(responses));
      const auto request = examination_.next(queue_.stop_requested() ? 0 : queue_.budget_left());
      if (request)
        awaited_ = queue_.ask(request->points, {&request->packing, 1}, Fidelity::fine, false);
      else
        finished_ = true;
    }
  }

  const Scoring& scoring_;
  CandidateQueue queue_;
  Examination examination_;
  std::vector<std::size_t> awaited_;  // numbers of the pending candidates
  bool finished_ = false;
};

AskedSearch::AskedSearch(std::unique_ptr<Answers> answers) : answers_(std::move(answers)) {
  SearchStart start;
  start.simulations = answers_->options().budget_simulations;
  start.earlier = answers_->earlier();
  start.readings = answers_->readings();
  for (const Parameter& parameter : answers_->parameters()) start.parameters.push_back(parameter.name);
  const auto keep = [this](const Progress& progress) {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    phase_ = progress.phase;
    progress_.phase = {};
  };
  search_ = std::make_unique<Search>(answers_->scoring(), answers_->options(), std::move(start), keep);
}

AskedSearch::~AskedSearch() = default;

Progress AskedSearch::progress(std::string& phase) const {
  const std::lock_guard lock(mutex_);
  phase = phase_;
  return progress_;
}

std::vector<Candidate> AskedSearch::suggest(std::size_t count) {
  for (;;) {
    auto candidates = next(count);
    const bool any = !candidates.empty();
    std::erase_if(candidates, [this](const Candidate& one) { return is_known(one); });
    for (const Candidate& one : candidates) asked_.emplace(one.number, one);
    if (!any || !candidates.empty()) return candidates;
  }
}

std::vector<Candidate> AskedSearch::next(std::size_t count) {
  auto candidates = search_->suggest(count);
  for (const Candidate& one : candidates) asked_by_the_search_ = std::max(asked_by_the_search_, one.number + 1);
  if (!candidates.empty() || !begin_examination()) return candidates;
  candidates = examination_->suggest(count);
  for (Candidate& one : candidates) one.number += asked_by_the_search_;
  return candidates;
}

/// False during the search, and if there is nothing to examine.
bool AskedSearch::begin_examination() {
  if (examination_) return true;
  if (!search_->finished() || stopped_) return false;
  found_ = search_->result();
  const bool any = found_.best.point.size() > 0 && !found_.best.failed;
  if (!any || found_.status == CalibrationStatus::out_of_reach) return false;
  const int left = answers_->options().budget_simulations - counts_.simulated - counts_.answered;
  examination_ = std::make_unique<AskedExamination>(*answers_, found_, std::max(0, left));
  return true;
}

bool AskedSearch::is_known(const Candidate& candidate) {
  const auto known = answers_->find(candidate);
  if (!known) return false;
  counts_.answered += known->simulations;
  tell(candidate, *known);
  return true;
}

Faults AskedSearch::faults_of(const EngineAnswer& answer, std::size_t place) const {
  const std::string where = "results[" + std::to_string(place) + "]";
  if (!asked_.contains(answer.candidate))
    return {{where, "answers candidate " + std::to_string(answer.candidate) + ", which nobody asked for",
             "the \"_id\" of a candidate that suggest() gave"}};
  Faults faults;
  if (answer.error) return faults;
  for (const std::string& reading : answers_->readings())
    if (!answer.readings.find(reading))
      faults.push_back({where, "has no \"" + reading + "\", which the laboratory measured",
                        "the number, NaN if there is none, or \"error\": why the simulation failed"});
  return faults;
}

Faults AskedSearch::ingest(const std::vector<EngineAnswer>& answers) {
  Faults faults;
  for (std::size_t i = 0; i < answers.size(); ++i) append(faults, faults_of(answers[i], i));
  if (!faults.empty()) return faults;
  for (const EngineAnswer& answer : answers) {
    const Candidate& candidate = asked_.at(answer.candidate);
    if (answers_->find(candidate)) continue;  // duplicate
    const auto kept = answers_->keep(candidate, answer);
    if (!kept.ok()) return kept.faults();
    counts_.simulated += kept.value().simulations;
    tell(candidate, kept.value());
  }
  return {};
}

void AskedSearch::tell(const Candidate& candidate, const Evaluation& evaluation) {
  if (evaluation.failure) ++counts_.failures[evaluation.failure->reason];
  CandidateResult result{candidate.number, evaluation};
  if (!examination_) return search_->ingest({&result, 1});
  if (result.candidate < asked_by_the_search_) return;  // late answer to the search
  result.candidate -= asked_by_the_search_;
  examination_->ingest(result);
}

void AskedSearch::stop() {
  stopped_ = true;
  search_->stop();
  if (examination_) examination_->stop();
}

bool AskedSearch::finished() {
  return search_->finished() && (!begin_examination() || examination_->finished());
}

/// Measured and simulated readings, as on a card.
static ordered_json readings_json(const Scoring& scoring, const Response& shown,
                                  const std::vector<ReadingTrainingData>& evidence) {
  ordered_json out = ordered_json::array();
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const double simulated = shown.readings[static_cast<Eigen::Index>(i)];
    out.push_back({{"name", evidence[i].name},
                   {"measured", *evidence[i].measured},
                   {"tolerance", scoring.tolerance(i)},
                   {"simulated", simulated},
                   {"standard_error", std::sqrt(squared_standard_error(shown, i))},
                   {"difference", simulated - *evidence[i].measured},
                   {"weight", evidence[i].weight}});
  }
  return out;
}

ordered_json AskedSearch::result() {
  CalibrationResult result;
  result.search = search_->result();
  result.counts = counts_;
  const Calibration& found = result.search;
  if (found.best.point.size() == 0 || found.best.failed) return result_json(result);
  result.card = answers_->card(found, counts_);
  if (examination_) result.inference = examination_->inference();
  if (result.inference && result.card) result.card->inference = card_inference(*result.inference);
  ordered_json out = result_json(result);
  if (result.card) return out;
  const Response& shown = shown_of(found);
  const auto parameters = answers_->parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    out["parameters"][parameters[i].name] = value_between(parameters[i], shown.point[static_cast<Eigen::Index>(i)]);
  out["readings"] = readings_json(answers_->scoring(), shown, answers_->evidence(found.history).readings);
  if (result.inference) out["summary"] = describe(*result.inference);
  return out;
}

}  // namespace pastefit::python
