#include "calibrate/search/comparison.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace pastefit {

namespace {

using Asked = std::tuple<std::vector<double>, std::uint64_t, bool>;

/// Normalised error of the incumbent after each simulation. One on more packings says more than one on fewer, and
/// replaces it even if it is larger: what was lucky is found out.
std::vector<double> course_of(const std::vector<Response>& history) {
  std::vector<double> course;
  std::set<Asked> asked;
  double best = -1;
  std::size_t packings = 0;
  for (const Response& response : history) {
    for (const Evaluation& one : response.evaluations)
      asked.insert({std::vector<double>(response.point.begin(), response.point.end()), one.packing, one.censored});
    course.resize(asked.size(), best);
    if (!is_whole(response) || response.packings.size() < packings) continue;
    if (best >= 0 && response.packings.size() == packings && response.error >= best) continue;
    best = response.error;
    packings = response.packings.size();
    course.back() = best;
  }
  return course;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return -1;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

std::vector<StrategyTrial> compare_strategies(const std::function<std::unique_ptr<Objective>(int budget)>& objective,
                                              const ComparisonOptions& options,
                                              const std::function<void(const StrategyTrial&)>& finished) {
  std::vector<StrategyTrial> trials;
  for (int k = 0; k < options.seeds; ++k) {
    for (const std::string& strategy : options.strategies) {
      SearchOptions search_options = options.search;
      search_options.strategy = strategy;
      search_options.seed += static_cast<std::uint64_t>(k);
      const auto own = objective(search_options.budget_simulations);
      const Calibration calibration = search(*own, search_options);
      if (own->stop_requested()) return trials;
      StrategyTrial trial{strategy,
                          search_options.seed,
                          calibration.status,
                          calibration.simulations,
                          calibration.failures,
                          course_of(calibration.history)};
      if (calibration.best.point.size() > 0) {
        const auto judge = objective(static_cast<int>(options.judge_packings.size()));
        const Response judged = judge->evaluate({&calibration.best.point, 1}, options.judge_packings).at(0);
        if (judge->stop_requested()) return trials;
        if (is_feasible(judged)) trial.judged = judged.error;
      }
      if (finished) finished(trial);
      trials.push_back(std::move(trial));
    }
  }
  return trials;
}

std::vector<StrategySummary> summary_of(const std::vector<StrategyTrial>& trials) {
  std::vector<StrategySummary> rows;
  for (const StrategyTrial& trial : trials) {
    if (std::ranges::find(rows, trial.strategy, &StrategySummary::strategy) != rows.end()) continue;
    StrategySummary row;
    row.strategy = trial.strategy;
    std::vector<double> simulations, judged;
    std::size_t longest = 0;
    std::vector<const StrategyTrial*> own;
    for (const StrategyTrial& other : trials) {
      if (other.strategy != trial.strategy) continue;
      own.push_back(&other);
      row.confirmed += other.status == CalibrationStatus::confirmed ? 1 : 0;
      simulations.push_back(other.simulations);
      if (other.judged >= 0) judged.push_back(other.judged);
      longest = std::max(longest, other.errors.size());
    }
    row.trials = static_cast<int>(own.size());
    row.simulations = median_of(simulations);
    row.judged = median_of(judged);
    if (!judged.empty()) row.worst_judged = *std::ranges::max_element(judged);
    for (std::size_t i = 0; i < longest; ++i) {
      std::vector<double> at;
      for (const StrategyTrial* one : own)
        if (!one->errors.empty()) at.push_back(one->errors[std::min(i, one->errors.size() - 1)]);
      row.errors.push_back(median_of(at));
    }
    rows.push_back(std::move(row));
  }
  std::ranges::stable_sort(rows, [](const StrategySummary& a, const StrategySummary& b) {
    return a.confirmed != b.confirmed ? a.confirmed > b.confirmed : a.simulations < b.simulations;
  });
  return rows;
}

}  // namespace pastefit
