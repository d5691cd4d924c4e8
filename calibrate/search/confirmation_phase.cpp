#include "calibrate/search/confirmation_phase.h"

#include <algorithm>
#include <iterator>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

bool RecommendationPhase::advance() {
  constexpr double little_noise = 0.03;  // [allowed misfit]
  constexpr int few = 3, many = 8, small_budget = 4 * many;
  const CandidateRanking ranking = state_.ranking();
  if (ranking.best().size() == 0) return true;
  const bool is_exact = ranking.surrogate().noise() < little_noise * state_.history.allowed_misfit();
  const int rounds = is_exact || state_.history.budget_left() + simulated_ < small_budget ? few : many;
  if (simulated_ >= rounds || !state_.may_go_on()) {
    if (StrategyState::is_likely(ranking, ranking.most_plausible())) found_ = ranking.most_plausible();
    return true;
  }
  ++simulated_;
  const auto misfit = [&](const UnitPoint& at) { return ranking.surrogate().misfit_posterior(at).mean(); };
  const UnitPoint point = least_point(misfit, ranking.best());
  state_.history.evaluate({&point, 1}, state_.fresh_packings(1));
  return false;
}

namespace {

constexpr double hardly_likely = 0.1;          // probability of success below which a confirmation is broken off
constexpr std::size_t most_confirmations = 8;  // largest number of fresh packings over that of the study
// The same number if only the share of rejected heaps is undecided: to find another candidate takes fewer simulations
// than to decide a share close to the limit.
constexpr std::size_t worthwhile_confirmations = 4;

}  // namespace

void ConfirmationPhase::begin(bool whatever_it_does, const UnitPoint& asked) {
  state_.history.enter("confirmation");
  state_.history.hold_back(0);
  candidate_ = asked.size() > 0 ? asked : state_.ranking().best();
  const int all = state_.options.confirmation_packings;
  fresh_ = state_.fresh_packings(state_.options.max_pending > 0 ? all : (all + 3) / 4);
  whatever_it_does_ = whatever_it_does;
}

void ConfirmationPhase::begin_last() {
  state_.history.hold_back(0);
  last_ = whatever_it_does_ = true;
  if (confirmed_ || confirmation_.packings.empty() || state_.history.stop_requested()) return;
  const bool broken_off =
      confirmation_.packings.size() < static_cast<std::size_t>(state_.options.confirmation_packings);
  const Evidence evidence = evidence_of(confirmation_);
  if (!broken_off && verdict_on(evidence, state_.scoring().rejected_share()) != Verdict::undecided) return;
  candidate_ = confirmation_.point;
  fresh_ = confirmation_.packings;
}

bool ConfirmationPhase::advance() {
  if (candidate_.size() == 0) return true;
  if (std::exchange(asked_, false)) {
    const Response confirmation = state_.history.answers().front();
    const auto [verdict, more] = look_at(confirmation);
    if (more == 0) {
      conclude(confirmation, verdict);
      return true;
    }
    std::ranges::copy(state_.fresh_packings(static_cast<int>(more)), std::back_inserter(fresh_));
  }
  asked_ = true;
  state_.history.evaluate({&candidate_, 1}, fresh_);
  return false;
}

std::pair<Verdict, std::size_t> ConfirmationPhase::look_at(const Response& confirmation) const {
  const auto all = static_cast<std::size_t>(state_.options.confirmation_packings);
  const auto least = std::max<std::size_t>(all, 2);  // the noise of a single packing is unknown
  const Evidence evidence = evidence_of(confirmation);
  const std::size_t asked = fresh_.size();
  Verdict verdict = Verdict::undecided;
  if (asked >= least)
    verdict = verdict_on(evidence, state_.scoring().rejected_share());
  else if (!whatever_it_does_ && state_.ranking().chance_of(candidate_, 1) < hardly_likely)
    verdict = Verdict::refuted;
  if (asked >= least && packings_to_decide(evidence) > most_confirmations * static_cast<double>(all))
    return {verdict, 0};
  if (verdict != Verdict::undecided || asked >= most_confirmations * all || state_.history.stop_requested())
    return {verdict, 0};
  const bool by_share = verdict_on_readings(evidence) != Verdict::undecided;  // the readings are decided
  if (by_share && !whatever_it_does_ && asked >= worthwhile_confirmations * all) return {verdict, 0};
  const std::size_t further = state_.options.max_pending > 0 ? all : (all + 1) / 2;
  const std::size_t more = asked < all ? all - asked : further;
  return {verdict, state_.affordable(more) ? more : 0};
}

void ConfirmationPhase::conclude(const Response& confirmation, Verdict verdict) {
  const UnitPoint judged = std::exchange(candidate_, {});
  if (state_.history.stop_requested()) return;
  confirmed_ = verdict == Verdict::meets;
  report(confirmation);
  if (last_) return;
  if (!confirmed_) state_.refuted.push_back(judged);
  state_.history.hold_back(state_.options.confirmation_packings);
}

void ConfirmationPhase::report(const Response& confirmation) {
  std::vector<std::uint64_t> tried;  // before its confirmation
  for (const Response& one : state_.history.singles())
    if (one.point == confirmation.point && is_whole(one) &&
        std::ranges::count(confirmation.packings, one.packings.front()) == 0)
      tried.push_back(one.packings.front());
  std::vector<std::uint64_t> joined = tried;
  std::ranges::copy(confirmation.packings, std::back_inserter(joined));
  const Response all = state_.history.recall(confirmation.point, joined);
  const bool first = confirmation_.point.size() == 0 || confirmation_.point == confirmation.point;
  const double share = state_.scoring().rejected_share();
  if (!confirmed_ && !first && shortfall(evidence_of(all), share) >= shortfall(evidence_of(best_), share)) return;
  best_ = all;
  search_ = state_.history.recall(confirmation.point, tried);
  confirmation_ = confirmation;
}

}  // namespace pastefit
