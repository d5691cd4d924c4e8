#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/search/search.h"

namespace pastefit {

/// What answers a search by calls that wait. Guarantee: the answer depends on (point, packings) only, not on threads,
/// order or earlier requests.
class Objective : public virtual Scoring {
 public:
  /// Simulates all points on the same packings; returns the responses in the order of the points. Points outside the
  /// unit cube are a programming error (checked).
  virtual std::vector<Response> evaluate(std::span<const UnitPoint> points,
                                         std::span<const std::uint64_t> packings) = 0;
  /// The same for candidates that need no complete result: a simulation may end as soon as the candidate is clearly
  /// worse, and omits the energy balance, which confirmations check on other packings. The readings that it takes equal
  /// those of `evaluate`.
  virtual std::vector<Response> try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) {
    return evaluate(points, packings);
  }
  /// Starts points without waiting, if possible; `try_out`, or `evaluate` if they may not end early, then waits. It
  /// changes no answer; points count in the budget only when requested.
  virtual void begin(std::span<const UnitPoint>, std::span<const std::uint64_t>, bool /*may_end_early*/) {}
  /// Remaining budget in points on a packing, each counted once however often it is requested.
  virtual int budget_left() const = 0;
  /// The same in simulations.
  virtual int simulations_left() const { return budget_left() * simulations_each(); }
  /// Responses known at the start, each on one packing; not counted in the budget.
  virtual std::vector<Response> earlier() const { return {}; }
  /// True after a stop request of the user or a limit: a search then returns its best so far.
  virtual bool stop_requested() const = 0;
};

/// Runs a search with objectives until it finishes or `objective` requests a stop.
inline Calibration drive(Search& search, Objective& objective, Objective* coarse = nullptr) {
  const auto of = [&](const Candidate& one) -> Objective& {
    return one.fidelity == Fidelity::fine ? objective : *coarse;
  };
  std::deque<Candidate> under_way;
  while (!search.finished()) {
    if (objective.stop_requested()) search.stop();
    const auto candidates = search.suggest(std::numeric_limits<std::size_t>::max());
    for (const Candidate& one : candidates) {
      of(one).begin({&one.point, 1}, {&one.packing, 1}, one.may_end_early);
      under_way.push_back(one);
    }
    if (!candidates.empty() || under_way.empty()) continue;
    const Candidate first = std::move(under_way.front());
    under_way.pop_front();
    const auto answer = first.may_end_early ? &Objective::try_out : &Objective::evaluate;
    const Response response = (of(first).*answer)({&first.point, 1}, {&first.packing, 1}).at(0);
    const CandidateResult result{first.number, response.evaluations.at(0)};
    search.ingest({&result, 1});
  }
  return search.result();
}

/// Creates and runs a search. `readings`, `parameters`: names for the reason; may be empty. `coarse`: with coarser
/// grains, for packings from `coarse_packings` on; default strategy only.
inline Calibration search(Objective& objective, const SearchOptions& options,
                          const std::function<void(const Progress&)>& progress = {},
                          std::span<const std::string> readings = {}, std::span<const std::string> parameters = {},
                          Objective* coarse = nullptr) {
  Search search(objective, options,
                {.simulations = objective.simulations_left(),
                 .with_coarse = coarse != nullptr,
                 .earlier = objective.earlier(),
                 .readings = {readings.begin(), readings.end()},
                 .parameters = {parameters.begin(), parameters.end()}},
                progress);
  return drive(search, objective, coarse);
}

}  // namespace pastefit
