#include "tests/twins/twin.h"

#include <chrono>
#include <cmath>

#include "calibrate/evaluate/response.h"
#include "calibrate/inference/response_model.h"
#include "calibrate/search/screening.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"
#include "core/random.h"

namespace pastefit {

namespace {

constexpr std::uint64_t first_packing = 2'000'000'000;  // far from those of any search
constexpr double least_deviation_mm = 1;                // of repeats that happen to agree

double ruler_of(const std::string& reading, const TwinRecipe& recipe) {
  return reading.find("spread") != std::string::npos ? 5 * recipe.ruler_mm : recipe.ruler_mm;
}

/// The best determined combination of the truth, as a value of its lead: the one at which the recommended material
/// would read what the truth reads.
double true_lead_of(const Twin& twin, const Store& store, const UnitPoint& recommended, std::size_t lead) {
  const ResponseModel model(training_data_of(twin.study, store.all()));
  const auto& readings = model.training_data().readings;
  double least = std::numeric_limits<double>::infinity(), at = 0;
  constexpr int cells = 1000;
  for (int i = 0; i <= cells; ++i) {
    UnitPoint point = recommended;
    point[static_cast<Eigen::Index>(lead)] = static_cast<double>(i) / cells;
    double squares = 0;
    for (std::size_t k = 0; k < readings.size(); ++k) {
      if (!readings[k].fitted()) continue;
      for (std::size_t m = 0; m < twin.study.tests[0].lab.measurements.size(); ++m)
        if (twin.study.tests[0].lab.measurements[m].reading == readings[k].name)
          squares += std::pow((model.predict(k, point).mean - twin.true_readings[m]) / readings[k].deviation, 2);
    }
    if (squares >= least) continue;
    least = squares;
    at = point[static_cast<Eigen::Index>(lead)];
  }
  return value_between(model.training_data().parameters[lead], at);
}

}  // namespace

Result<Twin> make_twin(const Study& study, const TwinRecipe& recipe, int number, const PoolOptions& options) {
  Twin twin;
  twin.number = number;
  twin.study = study;
  twin.truth = screening_points(free_count(study), number + 1, recipe.seed).back();
  const std::vector<double> values = values_at(study, coordinates(twin.truth));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (study.parameters[i].free) twin.values.push_back(values[i]);

  std::vector<Readings> runs;
  for (int k = 0; k < recipe.repeats; ++k) {
    Study made = study;
    GrainSizes& grains = specimen_of(made.tests[0].lab.test).grains;
    if (recipe.truth_radius_m > 0) grains = enlarged(grains, recipe.truth_radius_m / grains.radius_m);
    const auto packing = first_packing + static_cast<std::uint64_t>(1000 * number + k);
    const Outcome outcome = options.engine.run(test_with(made.tests[0].lab.test, values, packing), {});
    if (outcome.failure) return Fault{"twin " + std::to_string(number), outcome.failure->message, "another truth"};
    runs.push_back(outcome.readings);
  }
  const RandomStream ruler(recipe.seed, "ruler");
  for (std::size_t m = 0; m < twin.study.tests[0].lab.measurements.size(); ++m) {
    Measurement& measurement = twin.study.tests[0].lab.measurements[m];
    std::vector<double> read;
    double truth = 0, mean = 0, squares = 0;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const double value = runs[k].find(measurement.reading).value_or(std::nan(""));
      const auto draw = (static_cast<std::uint64_t>(number) * 100 + m) * 100 + k;
      read.push_back(value + ruler_of(measurement.reading, recipe) * ruler.normal(draw));
      truth += value / recipe.repeats;
      mean += read.back() / recipe.repeats;
    }
    if (!std::isfinite(mean))
      return Fault{"twin " + std::to_string(number), "gave no " + measurement.reading, "another truth"};
    for (const double value : read) squares += (value - mean) * (value - mean) / std::max(1, recipe.repeats - 1);
    measurement.value = mean;
    measurement.standard_deviation = std::max(std::sqrt(squares), least_deviation_mm);
    measurement.repeats = recipe.repeats;
    twin.true_readings.push_back(truth);
  }
  twin.study.tests[0].lab.content =
      "\"twin " + std::to_string(number) + " of seed " + std::to_string(recipe.seed) + "\"";
  return twin;
}

TwinResult calibrate_twin(const Twin& twin, const std::filesystem::path& store_file, const PoolOptions& options) {
  TwinResult result;
  result.number = twin.number;
  const auto start = std::chrono::steady_clock::now();
  auto store = Store::open(store_file, {program_identity(), inputs_of(twin.study)});
  if (!store.ok()) {
    result.status = "no store: " + store.faults().front().what;
    return result;
  }
  const auto calibrated = calibrate(twin.study, store.value(), options);
  if (!calibrated.ok()) {
    result.status = message_of(calibrated.faults());
    return result;
  }
  const Calibration& calibration = calibrated.value().search;
  result.status = name_of(calibration.status);
  if (!calibrated.value().inference) return result;
  const Inference& inference = *calibrated.value().inference;
  result.simulations = calibrated.value().counts.known();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const bool fresh = calibration.confirmation.point.size() > 0 && is_feasible(calibration.confirmation);
  const Response& shown = fresh ? calibration.confirmation : calibration.best;
  for (std::size_t m = 0; m < twin.study.tests[0].lab.measurements.size(); ++m) {
    if (twin.study.tests[0].targets[m].weight == 0) continue;
    const Measurement& measurement = twin.study.tests[0].lab.measurements[m];
    const double mean = shown.readings[static_cast<Eigen::Index>(m)];
    const double error =
        std::sqrt(std::pow(measurement.standard_deviation, 2) / measurement.repeats + squared_standard_error(shown, m));
    result.misses.push_back(std::abs(mean - measurement.value) / error);
  }
  for (std::size_t j = 0; j < inference.intervals.size(); ++j) {
    const ParameterInterval& one = inference.intervals[j];
    result.parameters.push_back({one.parameter.name, twin.values[j], one.recommended, one.lower.at, one.upper.at,
                                 one.lower.known, one.upper.known});
  }
  for (const Combination& combination : inference.combinations) result.determined += combination.determined() ? 1 : 0;
  if (result.determined == 0) return result;
  const std::size_t lead = inference.combinations.front().lead;
  const ParameterInterval& interval = inference.intervals[lead];
  const double truth = true_lead_of(twin, store.value(), calibration.best.point, lead);
  result.lead = interval.parameter.name;
  result.lead_error =
      std::abs(truth - interval.recommended) / (interval.parameter.scale == Scale::logarithmic
                                                    ? interval.recommended
                                                    : interval.parameter.upper - interval.parameter.lower);
  result.lead_held = truth >= interval.held_lower.at && truth <= interval.held_upper.at;
  return result;
}

}  // namespace pastefit
