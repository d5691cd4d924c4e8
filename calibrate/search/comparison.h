#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "calibrate/search/search.h"

namespace pastefit {

/// One strategy's way through a study.
struct StrategyTrial {
  std::string strategy;
  std::uint64_t seed = 0;
  CalibrationStatus status = CalibrationStatus::failed;
  int simulations = 0;
  int failures = 0;
  std::vector<double> errors;  ///< of the incumbent after each simulation; negative: no candidate yet
  double judged = -1;          ///< that of the result on packings no strategy has seen; negative: there is no result
};

/// What is compared, and how.
struct ComparisonOptions {
  std::vector<std::string> strategies;        ///< of `strategy_names()`
  int seeds = 1;                              ///< trials of each strategy, with search seeds from `search.seed` on
  SearchOptions search;                       ///< budget, packings and tolerance of every trial
  std::vector<std::uint64_t> judge_packings;  ///< on which every result is judged, outside of the budget
};

/// Runs every strategy with the same budget, each trial on an objective of its own, and judges all results on the same
/// packings. Screening asks every strategy the same points of the same seed; the way parts after it.
/// `objective(budget)` makes an objective that has spent nothing; they may share a store. Calls `finished` after each
/// trial. Ends early when an objective wants to stop; the trial that was cut off is left out.
std::vector<StrategyTrial> compare_strategies(const std::function<std::unique_ptr<Objective>(int budget)>& objective,
                                              const ComparisonOptions& options,
                                              const std::function<void(const StrategyTrial&)>& finished = {});

/// The trials of one strategy in one row: the middle one of each number, by its own order.
struct StrategySummary {
  std::string strategy;
  int trials = 0;
  int confirmed = 0;
  double simulations = 0;      ///< median
  double judged = -1;          ///< median of the trials with a result; negative: none
  double worst_judged = -1;    ///< the same, worst
  std::vector<double> errors;  ///< median after each simulation, trials that have ended counting on
};

/// One row for each strategy: those that meet the tolerance in most trials first, then those with fewer simulations.
std::vector<StrategySummary> summary_of(const std::vector<StrategyTrial>& trials);

}  // namespace pastefit
