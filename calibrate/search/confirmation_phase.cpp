#include "calibrate/search/confirmation_phase.h"

#include <algorithm>
#include <iterator>

#include "calibrate/judge/verdict.h"

namespace pastefit {
namespace {

constexpr double hardly_likely = 0.1;          // that a candidate will do: its confirmation is broken off
constexpr std::size_t most_confirmations = 8;  // the fresh packings grow to so many times what the study asks for
// To so many where only the share of rejected heaps is not told: another material is sooner found than a share of
// nearly what is allowed is bounded.
constexpr std::size_t worthwhile_confirmations = 4;

}  // namespace

bool ConfirmationPhase::confirm(bool whatever_it_does, const UnitPoint& asked) {
  state_.history.enter("confirmation");
  state_.history.hold_back(0);
  const UnitPoint candidate = asked.size() > 0 ? asked : state_.ranking().best();
  if (!judge(candidate, state_.fresh_packings(first_packings()), whatever_it_does)) return false;
  ++rounds_;
  if (!confirmed_) state_.refuted.push_back(candidate);
  state_.history.hold_back(state_.options.confirmation_packings);
  return confirmed_;
}

bool ConfirmationPhase::judge(const UnitPoint& candidate, std::vector<std::uint64_t> fresh, bool whatever_it_does) {
  const auto all = static_cast<std::size_t>(state_.options.confirmation_packings);
  const auto least = std::max<std::size_t>(all, 2);  // of a single packing the noise is not known
  Response confirmation;
  Verdict verdict = Verdict::undecided;
  while (true) {
    confirmation = state_.history.evaluate({&candidate, 1}, fresh).at(0);
    const Evidence evidence = evidence_of(confirmation);
    const std::size_t asked = fresh.size();
    if (asked >= least)
      verdict = verdict_on(evidence, state_.scoring().rejected_share());
    else if (!whatever_it_does && state_.ranking().chance_of(candidate, 1) < hardly_likely)
      verdict = Verdict::refuted;
    if (asked >= least && packings_to_decide(evidence) > most_confirmations * static_cast<double>(all)) break;
    if (verdict != Verdict::undecided || asked >= most_confirmations * all || state_.history.stop_requested()) break;
    const bool by_share = verdict_on_readings(evidence) != Verdict::undecided;  // the readings are told
    if (by_share && !whatever_it_does && asked >= worthwhile_confirmations * all) break;
    const std::size_t more = asked < all ? all - asked : further_packings();
    if (!state_.affordable(more)) break;
    std::ranges::copy(state_.fresh_packings(static_cast<int>(more)), std::back_inserter(fresh));
  }
  if (state_.history.stop_requested()) return false;
  confirmed_ = verdict == Verdict::meets;
  report(confirmation);
  return true;
}

int ConfirmationPhase::first_packings() const {
  const int all = state_.options.confirmation_packings;
  return state_.options.max_pending > 0 ? all : (all + 3) / 4;
}

std::size_t ConfirmationPhase::further_packings() const {
  const int all = state_.options.confirmation_packings;
  return static_cast<std::size_t>(state_.options.max_pending > 0 ? all : (all + 1) / 2);
}

void ConfirmationPhase::report(const Response& confirmation) {
  std::vector<std::uint64_t> tried;  // before it was judged
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

void ConfirmationPhase::finish() {
  state_.history.hold_back(0);
  if (confirmed_ || confirmation_.packings.empty() || state_.history.stop_requested()) return;
  const bool broken_off =
      confirmation_.packings.size() < static_cast<std::size_t>(state_.options.confirmation_packings);
  if (!broken_off && verdict_on(evidence_of(confirmation_), state_.scoring().rejected_share()) != Verdict::undecided)
    return;
  (void)judge(confirmation_.point, confirmation_.packings, true);
}

}  // namespace pastefit
