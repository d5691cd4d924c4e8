#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/search/candidate_queue.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Method that proposes candidates.
enum class StrategyKind {
  surrogate,  ///< Gaussian processes with expected improvement: `proposals.h`
  ceres,      ///< trust region on the residuals
  nlopt       ///< NLopt algorithm on the misfit
};

/// To add a strategy, add a row to `strategies`; a new kind also needs a function in `candidate_search.cpp`.
struct StrategyRow {
  std::string_view name;
  StrategyKind kind = StrategyKind::surrogate;
};
const std::vector<StrategyRow>& strategies();
/// Null if no strategy has that name.
const StrategyRow* find_strategy(std::string_view name);

/// Errors in the options for this number of parameters and fitted tests; empty if valid.
Faults validate(const SearchOptions& options, int parameters, int tests = 1);

/// Initial state of a search.
struct SearchStart {
  int simulations = 0;                       ///< total allowed, one for each fitted test of a candidate
  bool with_coarse = false;                  ///< allows coarse candidates (`low_fidelity.h`)
  std::vector<Response> earlier = {};        ///< known responses, each on one packing; not counted in the budget
  std::vector<std::string> readings = {};    ///< names for the reason, one for each reading; may be empty
  std::vector<std::string> parameters = {};  ///< names of the free parameters; may be empty
};

}  // namespace pastefit
