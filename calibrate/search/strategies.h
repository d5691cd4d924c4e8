#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/search/candidate_queue.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Who looks for candidates.
enum class StrategyKind {
  surrogate,  ///< Gaussian processes and what they promise: `proposals.h`
  ceres,      ///< a trust region on the residuals
  nlopt       ///< an algorithm on the misfit
};

/// To add a strategy: a row in `strategies`, and for a new kind a function in `candidate_search.cpp`.
struct StrategyRow {
  std::string_view name;
  StrategyKind kind = StrategyKind::surrogate;
};
const std::vector<StrategyRow>& strategies();
/// No row if there is no strategy of that name.
const StrategyRow* find_strategy(std::string_view name);

/// Everything wrong with the options of a search over so many parameters and fitted tests; empty: fit to run.
Faults validate(const SearchOptions& options, int parameters, int tests = 1);

/// What a search starts from, besides its options.
struct SearchStart {
  int simulations = 0;                        ///< allowed in all, one for each fitted test of a candidate
  bool with_coarse = false;                   ///< coarse candidates may be suggested (`low_fidelity.h`)
  std::vector<Response> earlier = {};         ///< what is known, each point on one packing; free of charge
  std::vector<std::string> readings = {};     ///< names for the reason, in the order of the readings; may be empty
  std::vector<std::string> parameters = {};   ///< the same of the free parameters
  std::vector<CandidateResult> answers = {};  ///< of an earlier search that started the same: `Search::results`
};

}  // namespace pastefit
