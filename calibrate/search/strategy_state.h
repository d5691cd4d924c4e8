#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibrate/search/candidate_ranking.h"
#include "calibrate/search/evaluation_history.h"
#include "calibrate/search/strategies.h"

namespace pastefit {

/// A search of seed s draws packings from 1000 s on and leaves out a hundred from here: those of the examination
/// (`inference/examination.h`).
inline constexpr std::uint64_t first_examination_packing = 900;

/// A phase of a search. It never waits: `advance` goes on as far as the answers reach, asks the history for what it
/// needs next and returns false; it is called again once the answers are taken. It returns true when the phase is over.
class SearchPhase {
 public:
  virtual ~SearchPhase() = default;
  virtual bool advance() = 0;
};

/// What the phases of a strategy share: all answers, the packings on which an optimiser's candidates are compared, and
/// the candidates that a confirmation has judged.
class StrategyState {
  std::uint64_t packings_used_ = 0;  // first: `common` uses some

 public:
  StrategyState(CandidateQueue& queue, const SearchOptions& asked, const SearchStart& start,
                const std::function<void(const Progress&)>& progress)
      : options(asked), history(queue, start.earlier, asked, progress), common(fresh_packings(asked.packings)) {}

  const SearchOptions& options;
  EvaluationHistory history;
  const std::vector<std::uint64_t> common;  ///< an optimiser's candidates are compared on these
  std::vector<UnitPoint> refuted;           ///< by a confirmation

  const Scoring& scoring() const { return history.scoring(); }

  /// Packing seeds that no simulation of this search has used.
  std::vector<std::uint64_t> fresh_packings(int count);
  bool affordable(std::size_t packings) const { return history.budget_left() >= static_cast<int>(packings); }
  bool may_go_on() const { return !history.stop_requested() && affordable(common.size()); }

  /// The candidates in the light of all answers. Requirement: some evidence is feasible.
  CandidateRanking ranking() const { return {history, refuted}; }
  /// True if the best candidate is more likely than not to do.
  static bool goal_is_met(const CandidateRanking& ranking);
  /// The same whatever the heaps that a laboratory rejects.
  static bool readings_will_do(const CandidateRanking& ranking);
  /// The normalised error at which an optimiser may end by itself; none where what is known beforehand has a say.
  double optimisers_goal() const;
};

}  // namespace pastefit
