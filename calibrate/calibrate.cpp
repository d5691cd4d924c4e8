#include "calibrate/calibrate.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "calibrate/card/calibration_card.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/inference/description.h"
#include "calibrate/inference/examination.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"
#include "calibrate/study/tolerance.h"

namespace pastefit {

namespace {

/// Search options without the simulations that the held-out tests need after the search.
SearchOptions options_of_the_search(const Study& study) {
  SearchOptions options = study.search;
  options.budget_simulations -= hold_out_simulations(study, study.search);
  return options;
}

/// Reasons why `coarse_first` cannot be used.
Faults coarse_faults(const Study& study) {
  const std::string where = "search.coarse_first";
  const auto why = [&](std::size_t test) { return why_of_that_size(study.tests[test].lab.test); };
  const auto fitted = tests_of(study, false);
  if (std::ranges::none_of(fitted, [&](std::size_t test) { return why(test).empty(); }))
    return {{where, std::string(why(fitted.front())), "leave it out"}};
  const Study coarse = with_coarse_grains(study);
  const std::vector<double> middle(static_cast<std::size_t>(free_count(study)), 0.5);
  for (const StudyTest& test : coarse.tests)
    if (const auto faults = validate_in_file_words(test_with(test.lab.test, values_at(coarse, middle), 1));
        !faults.empty())
      return {{where, "with coarse grains: " + faults.front().what, "leave it out, or take smaller grains"}};
  return {};
}

std::vector<std::string> names_of_readings(const Study& study) {
  std::vector<std::string> names;
  for (const StudyReading& reading : readings_of(study)) names.push_back(reading.name);
  return names;
}

std::vector<std::string> names_of_free_parameters(const Study& study) {
  std::vector<std::string> names;
  for (const Parameter& parameter : study.parameters)
    if (parameter.free) names.push_back(parameter.name);
  return names;
}

EvaluatorOptions evaluator_of(const Study& study, const CalibrateOptions& options,
                              const CalibrateCallbacks& callbacks) {
  EvaluatorOptions evaluator;
  evaluator.threads = options.threads;
  evaluator.budget = study.search.budget_simulations;
  evaluator.wall_budget_s = options.wall_budget_s;
  evaluator.core_budget_s = options.core_budget_s;
  evaluator.stop = options.stop;
  evaluator.observer = callbacks.evaluated;
  evaluator.pulse = callbacks.pulse;
  evaluator.run_observer = callbacks.run_observer;
  evaluator.engine = options.engine;
  return evaluator;
}

/// Effects of unstated test conditions on the readings of a confirmed material.
std::vector<ConditionEffect> effects_on(const Calibration& found, const Study& study, Store& store,
                                        const EvaluatorOptions& evaluator, const SimulationObjective& objective,
                                        EvaluationCounts& counts) {
  if (found.status != CalibrationStatus::confirmed || study.search.examination_simulations == 0) return {};
  const auto simulate = [&](const Study& changed, const UnitPoint& point, std::span<const std::uint64_t> packings,
                            std::size_t test) {
    if (objective.stop_requested()) return std::vector<StoredEvaluation>{};
    SimulationObjective other(changed, store, evaluator);
    auto runs = other.predict(point, packings, test);
    counts += other.counts();
    if (objective.stop_requested()) runs.clear();  // some runs were cut off
    return runs;
  };
  const auto& fresh = found.confirmation.packings;
  return condition_effects(study, found.confirmation.point,
                           std::span(fresh).first(std::min(fresh.size(), condition_packings)),
                           objective.simulations_left(), simulate);
}

}  // namespace

Faults validate(const Study& study, const CalibrateOptions& options) {
  const auto fitted = static_cast<int>(tests_of(study, false).size());
  if (auto faults = validate(options_of_the_search(study), free_count(study), fitted); !faults.empty()) return faults;
  if (auto faults = validate_residuals(study); !faults.empty()) return faults;
  if (auto faults = validate_memory(study, options.threads); !faults.empty()) return faults;
  return study.search.coarse_first ? coarse_faults(study) : Faults{};
}

Result<CalibrationResult> calibrate(const Study& study, Store& store, const CalibrateOptions& options,
                                    const CalibrateCallbacks& callbacks) {
  if (auto faults = validate(study, options); !faults.empty()) return faults;
  const SearchOptions& asked = study.search;
  EvaluatorOptions evaluator = evaluator_of(study, options, callbacks);
  SimulationObjective objective(study, store, evaluator);
  evaluator.observer = {};
  evaluator.run_observer = nullptr;
  const Study coarse_study = with_coarse_grains(study);
  SimulationObjective coarse(coarse_study, store, evaluator);

  CalibrationResult result;
  result.search = search(objective, options_of_the_search(study), callbacks.progress, names_of_readings(study),
                         names_of_free_parameters(study), asked.coarse_first ? &coarse : nullptr);
  const Calibration& found = result.search;
  const bool any = found.best.point.size() > 0 && !found.best.failed;
  if (any) {
    if (callbacks.progress)
      callbacks.progress(Progress{"examination", 0, asked.budget_simulations, found.best.error, ""});
    predict_hold_outs(study, found, objective);
    // Readings out of reach determine no parameter; an interruption should end soon.
    const bool stopped = options.stop && *options.stop;
    if (found.status != CalibrationStatus::out_of_reach && !stopped) {
      const auto effects = effects_on(found, study, store, evaluator, objective, result.counts);
      const int spent = (result.counts.simulated + result.counts.answered) / objective.simulations_each();
      result.inference =
          examine(study, objective, store, found,
                  std::min(asked.examination_simulations, objective.budget_left() - spent), asked.seed, effects);
    }
  }
  if (auto faults = objective.store_faults(); !faults.empty()) return faults;
  result.counts += objective.counts();
  if (!any) return result;
  result.card =
      card_of(study, found, asked, baselines_of(study, shown_of(found), store), result.counts, options.study_file);
  if (result.inference) result.card->inference = card_inference(*result.inference);
  return result;
}

}  // namespace pastefit
