#include "calibrate/calibrator.h"

#include <algorithm>
#include <utility>

#include "calibrate/inference/description.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

SearchOptions search_options(const Answers& answers) {
  const auto study = answers.whole_study();
  return study ? options_of_the_search(*study) : answers.options();
}

SearchStart start_of(const Answers& answers) {
  SearchStart start{.simulations = answers.options().budget_simulations,
                    .with_coarse = answers.whole_study() && answers.options().coarse_first,
                    .earlier = answers.earlier(),
                    .readings = answers.readings()};
  for (const Parameter& parameter : answers.parameters()) start.parameters.push_back(parameter.name);
  return start;
}

bool has_material(const Calibration& found) {
  return found.best.point.size() > 0 && !found.best.failed;
}

bool is_fresh(const Calibration& found) {
  return found.confirmation.point.size() > 0 && !found.confirmation.failed;
}

}  // namespace

Calibrator::Calibrator(Answers& answers, std::function<void(const Progress&)> progress)
    : answers_(answers),
      options_(answers.options()),
      progress_(std::move(progress)),
      search_(answers.scoring(), search_options(answers), start_of(answers), progress_) {}

std::vector<Simulation> Calibrator::suggest(std::size_t count) {
  std::vector<Simulation> suggested;
  for (std::size_t candidates = 0; candidates < count;) {
    advance();
    const auto number = next_candidate();
    if (!number) break;
    const auto unknown = unknown_simulations_of(*number);
    suggested.insert(suggested.end(), unknown.begin(), unknown.end());
    candidates += unknown.empty() ? 0 : 1;
  }
  return suggested;
}

std::optional<std::size_t> Calibrator::next_candidate() {
  if (stage_ == Stage::search) {
    const auto candidates = search_.suggest(1);
    if (candidates.empty()) return std::nullopt;
    auto& asked = asked_.emplace_back(Asked{answers_.simulations_of(candidates[0]), {}});
    asked.counts = candidates[0].fidelity == Fidelity::fine;
    return candidates[0].number;
  }
  if (open_.empty()) return std::nullopt;
  const std::size_t number = open_.front();
  open_.pop_front();
  return number;
}

/// Enters what is stored; returns what is not.
std::vector<Simulation> Calibrator::unknown_simulations_of(std::size_t number) {
  const auto simulations = asked_[number].simulations;
  asked_[number].evaluations.resize(simulations.size());
  std::vector<Simulation> unknown;
  for (std::size_t place = 0; place < simulations.size(); ++place)
    if (auto known = answers_.find(simulations[place]))
      enter(number, place, std::move(*known), &EvaluationCounts::answered);
    else
      unknown.push_back(simulations[place]);
  return unknown;
}

Faults Calibrator::ingest(const Simulation& simulation, const StoredEvaluation& evaluation) {
  const auto& simulations = asked_.at(simulation.candidate).simulations;
  const auto known = std::ranges::find(simulations, simulation.test, &Simulation::test);
  const auto place = static_cast<std::size_t>(known - simulations.begin());
  if (!asked_[simulation.candidate].evaluations.at(place).key.empty()) return {};
  if (auto faults = answers_.add(evaluation); !faults.empty()) return faults;
  // The store may hold a damaged evaluation under this key, which is not found and not replaced.
  enter(simulation.candidate, place, answers_.find(simulation).value_or(evaluation), &EvaluationCounts::simulated);
  advance();
  return {};
}

void Calibrator::enter(std::size_t number, std::size_t place, StoredEvaluation evaluation,
                       int EvaluationCounts::*counter) {
  Asked& asked = asked_[number];
  if (asked.counts) {
    ++(counts_.*counter);
    if (const auto failure = answers_.failure_of(asked.simulations[place], evaluation))
      ++counts_.failures[failure->reason];
  }
  asked.evaluations[place] = std::move(evaluation);
  if (asked.is_answered()) tell(number);
}

bool Calibrator::Asked::is_answered() const {
  return !evaluations.empty() &&
         std::ranges::none_of(evaluations, [](const StoredEvaluation& one) { return one.key.empty(); });
}

Response Calibrator::response_of(const Asked& asked) const {
  return answers_.scoring().response_of({answers_.evaluation_of(asked.simulations, asked.evaluations)});
}

/// Tells the search; of the other stages `advance` asks.
void Calibrator::tell(std::size_t number) {
  const Asked& asked = asked_[number];
  const bool of_fitted_tests = stage_ == Stage::search || stage_ == Stage::examination;
  if (of_fitted_tests && asked.counts) {
    const Response response = response_of(asked);
    const bool good = !response.failed && !response.censored;
    if (good && (counts_.best_error < 0 || response.error < counts_.best_error)) counts_.best_error = response.error;
    note_material(response.evaluations.front());
  }
  if (stage_ != Stage::search) return;
  const CandidateResult result{number, answers_.evaluation_of(asked.simulations, asked.evaluations)};
  search_.ingest({&result, 1});
}

void Calibrator::note_material(Evaluation evaluation) {
  auto& evaluations = materials_[{evaluation.point.begin(), evaluation.point.end()}];
  evaluations.push_back(std::move(evaluation));
  Response material = answers_.scoring().response_of(evaluations);
  if (material.failed || material.censored) return;
  if (best_.point.size() == 0 || best_.point == material.point || material.error < best_.error)
    best_ = std::move(material);
}

void Calibrator::stop(bool infers) {
  stopped_ = true;
  if (stage_ == Stage::search || stage_ == Stage::hold_outs) infers_ = infers;
  open_.clear();
  search_.stop();
  advance();
}

void Calibrator::advance() {
  const auto is_answered = [&](std::size_t number) { return asked_[number].is_answered(); };
  while (stage_ != Stage::over) {
    if (stage_ == Stage::search ? !search_.finished() : !stopped_ && !std::ranges::all_of(awaited_, is_answered))
      return;
    switch (stage_) {
      case Stage::search:
        begin_hold_outs();
        break;
      case Stage::hold_outs:
        begin_conditions();
        break;
      case Stage::conditions:
        begin_examination();
        break;
      case Stage::examination:
        go_on_examining();
        break;
      case Stage::over:
        break;
    }
  }
}

/// Asks for a candidate after the search, unless it was stopped.
std::size_t Calibrator::ask(std::vector<Simulation> simulations) {
  const std::size_t number = asked_.size();
  for (Simulation& one : simulations) one.candidate = number;
  asked_.push_back({std::move(simulations), {}});
  if (!stopped_) open_.push_back(number);
  awaited_.push_back(number);
  return number;
}

void Calibrator::begin_hold_outs() {
  found_ = search_.result();
  stage_ = has_material(found_) ? Stage::hold_outs : Stage::over;
  if (stage_ == Stage::over) return;
  if (progress_) progress_({"examination", counts_.known(), options_.budget_simulations, found_.best.error, ""});
  const auto study = answers_.whole_study();
  if (!study || !is_fresh(found_)) return;
  const Response& fresh = found_.confirmation;
  for (const std::size_t test : tests_of(*study, true))
    for (const std::uint64_t packing : fresh.packings) ask({{0, study, test, fresh.point, packing, false, "hold-out"}});
}

void Calibrator::begin_conditions() {
  // Readings out of reach determine no parameter; an interruption should end soon.
  const bool infers = found_.status != CalibrationStatus::out_of_reach && infers_;
  stage_ = infers ? Stage::conditions : Stage::over;
  awaited_.clear();
  const int each = answers_.scoring().simulations_each();
  const int left = std::max(0, options_.budget_simulations - counts_.known());
  points_left_ = left / each;
  const auto study = answers_.whole_study();
  const bool confirmed = found_.status == CalibrationStatus::confirmed;
  if (!infers || !study || !confirmed || options_.examination_simulations == 0) return;
  const std::size_t packings = std::min(found_.confirmation.packings.size(), condition_packings);
  int unspent = left;
  for (UnstatedCondition& condition : affordable_conditions(*study, packings, unspent)) {
    auto lower = ask_at(1 / condition_range, condition, packings), upper = ask_at(condition_range, condition, packings);
    conditions_.push_back({std::move(condition), std::move(lower), std::move(upper)});
  }
  points_left_ -= (left - unspent) / each;
}

std::vector<std::size_t> Calibrator::ask_at(double factor, const UnstatedCondition& condition, std::size_t packings) {
  const auto changed = std::make_shared<const Study>(with_condition(*answers_.whole_study(), condition, factor));
  const Response& fresh = found_.confirmation;
  std::vector<std::size_t> numbers;
  for (const std::size_t test : condition.tests)
    for (std::size_t k = 0; k < packings; ++k)
      numbers.push_back(ask({{0, changed, test, fresh.point, fresh.packings[k], false, "condition"}}));
  return numbers;
}

/// Of the conditions of which all is known, up to the first that a stop cut off.
std::vector<ConditionEffect> Calibrator::effects() const {
  const auto evaluations = [&](const std::vector<std::size_t>& numbers) {
    std::vector<StoredEvaluation> runs;
    for (const std::size_t number : numbers)
      if (asked_[number].is_answered()) runs.push_back(asked_[number].evaluations[0]);
    return runs;
  };
  std::vector<ConditionEffect> effects;
  for (const AskedCondition& one : conditions_) {
    const auto lower = evaluations(one.lower), upper = evaluations(one.upper);
    if (lower.size() < one.lower.size() || upper.size() < one.upper.size()) break;
    effects.push_back(effect_of(*answers_.whole_study(), one.condition, lower, upper));
  }
  return effects;
}

void Calibrator::begin_examination() {
  stage_ = Stage::examination;
  awaited_.clear();
  const auto evidence = [this, effects = effects()](std::span<const Response> history) {
    TrainingData known = answers_.evidence(history);
    known.conditions = effects;
    return known;
  };
  examination_.emplace(evidence, found_, std::min(options_.examination_simulations, points_left_), options_.seed);
}

void Calibrator::go_on_examining() {
  std::vector<Response> responses;
  for (const std::size_t number : std::exchange(awaited_, {}))
    if (asked_[number].is_answered()) responses.push_back(response_of(asked_[number]));
  examination_->ingest(std::move(responses));
  const auto request = examination_->next(stopped_);
  if (!request) stage_ = Stage::over;
  if (request)
    for (const UnitPoint& point : request->points)
      ask(answers_.simulations_of({0, point, request->packing, Fidelity::fine, false, "examination"}));
}

CalibrationResult Calibrator::result() const {
  CalibrationResult result{search_.result(), counts_, {}, {}};
  if (!has_material(found_)) return result;
  result.card = answers_.card(found_, counts_);
  if (examination_) result.inference = examination_->result();
  if (result.card && result.inference) result.card->inference = card_inference(*result.inference);
  return result;
}

}  // namespace pastefit
