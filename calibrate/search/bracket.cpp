#include "calibrate/search/bracket.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pastefit {

namespace {

constexpr double kJump = 10;      // [allowances] between neighbours; those of a smooth response differ by less
constexpr double kFinest = 1e-5;  // of the range; nearer neighbours are one candidate
constexpr int kMostHalvings = 16;

/// What was simulated, in the order of the parameter.
std::vector<Response> in_order(const EvaluationHistory& history) {
  std::vector<Response> out;
  for (const Response& one : history.singles())
    if (is_feasible(one)) out.push_back(one);
  std::ranges::stable_sort(out, {}, [](const Response& one) { return one.point[0]; });
  return out;
}

/// A residual in allowances; 0 where it is no fitted reading, or was not taken.
double miss(const EvaluationHistory& history, const Response& one, std::size_t reading) {
  const auto k = static_cast<Eigen::Index>(reading);
  const double allowance = history.allowance(reading);
  return allowance > 0 && has_reading(one, k) ? one.residuals[k] / allowance : 0;
}

bool all_on_one_side(const EvaluationHistory& history, std::span<const Response> seen) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(history.readings()); ++k) {
    const auto above = [&](const Response& one) { return miss(history, one, k) > 1; };
    const auto below = [&](const Response& one) { return miss(history, one, k) < -1; };
    if (!seen.empty() && (std::ranges::all_of(seen, above) || std::ranges::all_of(seen, below))) return true;
  }
  return false;
}

/// The middle between the neighbours that differ most across the laboratory; nothing if none differ by more than this
/// many allowances.
std::optional<UnitPoint> middle_of_jump(const EvaluationHistory& history, std::span<const Response> seen, double jump) {
  std::optional<UnitPoint> middle;
  double largest = jump;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const Response &one = seen[i - 1], &other = seen[i];
    if (other.point[0] - one.point[0] < kFinest) continue;
    for (std::size_t k = 0; k < static_cast<std::size_t>(history.readings()); ++k) {
      const double before = miss(history, one, k), after = miss(history, other, k);
      const bool across = before * after < 0 && std::min(std::abs(before), std::abs(after)) > 1;
      if (!across || std::abs(before - after) <= largest) continue;
      largest = std::abs(before - after);
      middle = 0.5 * (one.point + other.point);
    }
  }
  return middle;
}

bool is_met(const Response& one) {
  return is_whole(one) && one.error <= 1;
}

}  // namespace

bool BracketPhase::advance() {
  EvaluationHistory& history = state_.history;
  const std::span<const std::uint64_t> first(state_.common.data(), 1);
  if (history.parameters() != 1 || history.stop_requested() || !history.any_feasible()) return true;
  const std::vector<Response> seen = in_order(history);
  if (!std::exchange(begun_, true) && all_on_one_side(history, seen) && history.budget_left() >= 2) {
    const std::vector<UnitPoint> ends{UnitPoint::Constant(1, 0), UnitPoint::Constant(1, 1)};
    history.try_out(ends, first);
    return false;
  }
  if (halvings_ == kMostHalvings || history.budget_left() < 1) return true;
  if (const auto met = std::ranges::find_if(seen, is_met); met != seen.end()) {
    if (halvings_ > 0) found_ = met->point;
    return true;
  }
  const std::optional<UnitPoint> middle = middle_of_jump(history, seen, halvings_ == 0 ? kJump : 0);
  if (!middle) return true;
  ++halvings_;
  history.try_out({&*middle, 1}, first);
  return false;
}

}  // namespace pastefit
