#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/search/candidate_ranking.h"
#include "calibrate/search/evaluation_history.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Method that proposes candidates.
enum class StrategyKind {
  surrogate,  ///< Gaussian processes with expected improvement: `proposals.h`
  ceres,      ///< trust region on the residuals
  nlopt       ///< NLopt algorithm on the misfit
};

/// Kind of the strategy of this name; none if there is no such strategy. A new kind also needs a function in
/// `candidate_search.cpp`.
std::optional<StrategyKind> kind_of_strategy(std::string_view name);

/// Errors in the options for this number of parameters and fitted tests; empty if valid.
Faults validate(const SearchOptions& options, int parameters, int tests = 1);

/// Initial state of a search.
struct SearchStart {
  int simulations = 0;                       ///< total allowed, one for each fitted test of a candidate
  bool with_coarse = false;                  ///< allows coarse candidates (`surrogate.h`)
  std::vector<Response> earlier = {};        ///< known responses, each on one packing; not counted in the budget
  std::vector<std::string> readings = {};    ///< names for the reason, one for each reading; may be empty
  std::vector<std::string> parameters = {};  ///< names of the free parameters; may be empty
};

/// A search of seed s uses packings from 1000 s on, except a hundred from here, which the examination
/// (`inference/examination.h`) uses.
inline constexpr std::uint64_t first_examination_packing = 900;

/// A phase of a search. `advance` goes as far as the answers allow: it requests what it needs next and returns false,
/// or returns true at the end of the phase. It does not block; the caller takes the answers and calls it again.
class SearchPhase {
 public:
  virtual ~SearchPhase() = default;
  virtual bool advance() = 0;
};

/// Shared state of the phases: answers, common packings, and rejected candidates.
class StrategyState {
  std::uint64_t packings_used_ = 0;  // declared first: initialising `common` uses it

 public:
  StrategyState(CandidateQueue& queue, const SearchOptions& asked, const SearchStart& start,
                const std::function<void(const Progress&)>& progress)
      : options(asked), history(queue, start.earlier, asked, progress), common(fresh_packings(asked.packings)) {}

  const SearchOptions& options;
  EvaluationHistory history;
  const std::vector<std::uint64_t> common;  ///< packings on which an optimiser's candidates are compared
  std::vector<UnitPoint> refuted;           ///< rejected by a confirmation

  const Scoring& scoring() const { return history.scoring(); }

  /// Packing seeds not yet used by this search.
  std::vector<std::uint64_t> fresh_packings(int count);
  bool affordable(std::size_t packings) const { return history.budget_left() >= static_cast<int>(packings); }
  bool may_go_on() const { return !history.stop_requested() && affordable(common.size()); }

  /// Ranking by all answers. Requirement: at least one feasible simulation.
  CandidateRanking ranking() const { return {history, refuted}; }
  /// True if the candidate is likely enough to be confirmed.
  static bool is_likely(const CandidateRanking& ranking, const UnitPoint& candidate);
  /// `is_likely` for the best candidate; false if there is none.
  static bool goal_is_met(const CandidateRanking& ranking);
  /// `goal_is_met` without the factor for rejected heaps.
  static bool readings_will_do(const CandidateRanking& ranking);
  /// Error at which an optimiser may end; 0 (none) if there are priors.
  double optimisers_goal() const;
};

}  // namespace pastefit
