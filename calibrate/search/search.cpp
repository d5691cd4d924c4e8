#include "calibrate/search/search.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "calibrate/search/candidate_search.h"
#include "calibrate/search/screening.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

namespace {

/// The options; throws if they are not valid.
const SearchOptions& checked(const SearchOptions& options, const Scoring& scoring) {
  if (!validate(options, scoring.parameters(), scoring.simulations_each()).empty())
    throw std::logic_error("search: options that are not valid");
  return options;
}

}  // namespace

Search::Search(const Scoring& scoring, const SearchOptions& options, SearchStart start,
               std::function<void(const Progress&)> progress)
    : options_(checked(options, scoring)),
      start_(std::move(start)),
      progress_(std::move(progress)),
      queue_(scoring, start_.simulations),
      by_surrogate_(kind_of_strategy(options_.strategy) == StrategyKind::surrogate),
      with_coarse_(start_.with_coarse && by_surrogate_),
      state_(queue_, options_, start_, progress_),
      confirmation_(state_) {
  state_.history.hold_back(options_.confirmation_packings);
  begin(Stage::coarse_screening, with_coarse_ ? std::make_unique<ScreeningPhase>(state_, Fidelity::coarse) : nullptr);
}

std::vector<Candidate> Search::suggest(std::size_t count) {
  advance();
  return queue_.suggest(count);
}

void Search::ingest(std::span<const CandidateResult> results) {
  queue_.ingest(results);
  advance();
}

void Search::stop() {
  queue_.stop();
  advance();
}

const Calibration& Search::result() const {
  if (!finished()) throw std::logic_error("search: it has not finished");
  return result_;
}

void Search::advance() {
  while (!finished() && !state_.history.is_waiting()) {
    state_.history.take_answers();
    if (!advanced_ || advanced_->advance()) go_on();
  }
}

void Search::begin(Stage stage, std::unique_ptr<SearchPhase> phase) {
  stage_ = stage;
  phase_ = std::move(phase);
  advanced_ = phase_.get();
}

void Search::begin_confirmation(Stage stage, bool whatever_it_does, const UnitPoint& asked) {
  begin(stage, nullptr);
  confirmation_.begin(whatever_it_does, asked);
  advanced_ = &confirmation_;
}

void Search::begin_reach() {
  const EvaluationHistory& history = state_.history;
  if (history.singles().empty() || !history.any_feasible() || history.stop_requested()) return begin_candidates();
  const int spare = history.budget_left() - static_cast<int>(state_.common.size());
  const int most_probes = std::min(state_.options.screening, spare);
  begin(Stage::reach, std::make_unique<ReachPhase>(state_.history, state_.common.front(), most_probes));
}

/// Simulates the candidate nearest to the unreachable reading on all common packings.
void Search::begin_nearest() {
  begin(Stage::nearest, nullptr);
  state_.history.evaluate({&out_of_reach_->nearest, 1}, state_.common);
}

void Search::begin_candidates() {
  searched_ = true;
  const auto feasible = [](const Response& one) { return is_feasible(one); };
  if (std::ranges::none_of(state_.history.training_data(), feasible) || !state_.may_go_on()) return begin_end();
  begin(Stage::candidates, candidate_phase(state_, with_coarse_));
}

void Search::begin_end() {
  begin(Stage::last_confirmation, nullptr);
  confirmation_.begin_last();
  advanced_ = &confirmation_;
}

void Search::go_on() {
  const EvaluationHistory& history = state_.history;
  switch (stage_) {
    case Stage::coarse_screening: {
      const bool known = !history.training_data().empty();
      return begin(Stage::screening, known ? nullptr : std::make_unique<ScreeningPhase>(state_, Fidelity::fine));
    }
    case Stage::screening:
      return begin(Stage::bracket, !with_coarse_ && by_surrogate_ ? std::make_unique<BracketPhase>(state_) : nullptr);
    case Stage::bracket: {
      const auto found = phase_ ? static_cast<const BracketPhase&>(*phase_).found() : std::nullopt;
      return found ? begin_confirmation(Stage::bracket_confirmation, true, *found) : begin_reach();
    }
    case Stage::bracket_confirmation:
      return confirmation_.confirmed() ? begin_end() : begin_reach();
    case Stage::reach:
      if (history.stop_requested()) return begin_candidates();
      out_of_reach_ = static_cast<const ReachPhase&>(*phase_).found();
      history.say(out_of_reach_ ? describe(*out_of_reach_, start_.readings, start_.parameters)
                                : describe_screening(history.singles(), start_.readings));
      return out_of_reach_ ? begin_nearest() : begin_candidates();
    case Stage::nearest:
      if (history.stop_requested() || state_.ranking().best().size() == 0) return go_on_after_nearest();
      return begin_confirmation(Stage::nearest_confirmation, true);
    case Stage::nearest_confirmation:
      return go_on_after_nearest();
    case Stage::candidates:
      if (state_.ranking().best().size() == 0) return begin_end();
      return begin(Stage::refinement, refinement_phase(state_));
    case Stage::refinement: {
      if (history.stop_requested()) return begin_end();
      // A minimiser's result already is a point of least misfit.
      const bool chooses = by_surrogate_ && StrategyState::goal_is_met(state_.ranking());
      return begin(Stage::recommendation, chooses ? std::make_unique<RecommendationPhase>(state_) : nullptr);
    }
    case Stage::recommendation: {
      const UnitPoint found = phase_ ? static_cast<const RecommendationPhase&>(*phase_).found() : UnitPoint{};
      return history.stop_requested() ? begin_end() : begin_confirmation(Stage::confirmation, false, found);
    }
    case Stage::confirmation:
      return confirmation_.confirmed() ? begin_end() : begin_candidates();
    case Stage::last_confirmation:
      return conclude();
    case Stage::over:
      return;
  }
}

void Search::go_on_after_nearest() {
  const bool over = state_.history.stop_requested() || confirmation_.confirmed() || claim_stands();
  return over ? begin_end() : begin_candidates();
}

bool Search::claim_stands() {
  const auto against = [&](const Response& one) { return contradicts(one, *out_of_reach_); };
  const auto contradiction = std::ranges::find_if(state_.history.singles(), against);
  if (contradiction == state_.history.singles().end()) {
    if (const auto again = known_out_of_reach(state_.history, ReachOf::simulations);
        again && again->reading == out_of_reach_->reading) {
      out_of_reach_ = again;
      return true;
    }
  }
  state_.history.say(describe_withdrawal(*out_of_reach_, start_.readings));
  out_of_reach_.reset();
  return false;
}

void Search::conclude() {
  result_.best = confirmation_.best();
  result_.search = confirmation_.search();
  result_.confirmation = confirmation_.confirmation();
  if (result_.best.point.size() == 0 && state_.history.any_feasible()) {
    result_.best = result_.search = state_.history.best(state_.common);
  }
  result_.history = state_.history.responses();
  result_.simulations = state_.history.simulations();
  result_.coarse_simulations = static_cast<int>(state_.history.coarse_singles().size());
  std::vector<double> allowances;
  for (std::size_t k = 0; std::ssize(allowances) < state_.scoring().readings(); ++k)
    allowances.push_back(state_.scoring().allowance(k));
  result_.reach = reach_of(state_.history.singles(), allowances,
                           corrected(state_.history.coarse_singles(), state_.history.singles()));
  std::optional<OutOfReach> out_of_reach;
  if (!confirmation_.confirmed() && !state_.history.stop_requested())
    out_of_reach = searched_ ? known_out_of_reach(state_.history, ReachOf::means) : out_of_reach_;
  explain(out_of_reach);
  stage_ = Stage::over;
}

}  // namespace pastefit
