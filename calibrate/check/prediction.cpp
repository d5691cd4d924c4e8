#include "calibrate/check/prediction.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "calibrate/base/statistics.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

using Runs = std::vector<Baseline::Run>;

/// Removes the readings of a stage, "step2.", from a run in which more than a tenth of the grains left the table, e.g.
/// when a heap slides off. Returns true if there was one.
bool take_out_spilled(Baseline::Run& run) {
  constexpr double most = 0.1;
  constexpr std::string_view share = "spilled_share";
  std::vector<std::string> stages;
  for (const Reading& one : run.readings.all())
    if (one.name.ends_with(share) && one.value > most)
      stages.push_back(one.name.substr(0, one.name.size() - share.size()));
  if (stages.empty()) return false;
  Readings left;
  for (const Reading& one : run.readings.all())
    if (std::ranges::none_of(stages, [&](const std::string& stage) { return one.name.starts_with(stage); }))
      left.set(one.name, one.value);
  run.readings = std::move(left);
  return true;
}

/// `accepted`: accepted runs of each material.
ReadingPrediction reading_of(const std::string& name, const std::vector<Runs>& accepted) {
  ReadingPrediction out;
  out.name = name;
  double squares = 0;
  int freedom = 0;
  for (const Runs& runs : accepted) {
    const Sample sample = sample_of(column_of(runs, name));
    if (sample.count == 0) continue;
    out.of_materials.push_back(sample.mean);
    out.heaps = std::max(out.heaps, sample.count);
    squares += (sample.count - 1) * sample.standard_deviation * sample.standard_deviation;
    freedom += sample.count - 1;
  }
  const auto [least, most] = std::ranges::minmax(out.of_materials);
  out.mean =
      std::reduce(out.of_materials.begin(), out.of_materials.end()) / static_cast<double>(out.of_materials.size());
  out.of_heap = freedom > 0 ? std::sqrt(squares / freedom) : 0;
  const boost::math::students_t distribution(std::max(1, freedom));
  const double scatter = boost::math::quantile(distribution, (1 + prediction_level) / 2) * out.of_heap;
  out.lower = least - scatter;
  out.upper = most + scatter;
  return out;
}

}  // namespace

double ReadingPrediction::width_left() const {
  const double between = sample_of(of_materials).standard_deviation;
  const double variance = between * between - of_heap * of_heap / std::max(heaps, 1);
  return variance > 0 ? of_test / std::sqrt(of_test * of_test + variance) : 1;
}

Result<Prediction> predict(const Card& card, std::span<const std::vector<double>> materials, const Test& asked,
                           std::span<const Measurement> measured, int count, int threads, const CheckEngine& engine) {
  std::vector<std::uint64_t> packings(static_cast<std::size_t>(count));
  std::iota(packings.begin(), packings.end(), 80'001);  // not used by any search
  const Test test = with_material_of(card, asked);
  std::vector<Runs> standing;
  Prediction out;
  std::optional<Fault> last;  // failed simulation
  for (const std::vector<double>& values : materials) {
    const Test candidate = with_contact_of(test, values);
    if (const auto faults = validate(candidate); !faults.empty()) return faults;
    auto outcomes = outcomes_of(candidate, packings, engine, threads);
    Runs runs;
    for (std::size_t i = 0; i < packings.size(); ++i) {
      const auto& failure = outcomes[i].failure;
      if (!failure) runs.push_back({packings[i], std::move(outcomes[i].readings)});
      if (!failure) continue;
      last = failure_in(packings[i], *failure);
      if (failure->reason == FailureReason::stopped) return *last;
      ++out.failed;
    }
    out.heaps += count;
    for (const Baseline::Run& run : runs) out.rejected += is_rejected(candidate, run.readings) ? 1 : 0;
    standing.push_back(runs.empty() ? Runs{} : accepted(candidate, runs));
    for (Baseline::Run& run : standing.back()) out.spilled += take_out_spilled(run) ? 1 : 0;
  }
  if (out.failed == out.heaps) return *last;
  for (const ReadingKind& kind : reading_kinds(test)) {
    const auto* one = find_measurement(measured, kind.name);
    const auto has_it = [&](const Runs& runs) { return !column_of(runs, kind.name).empty(); };
    if ((!kind.advised && !one) || std::ranges::none_of(standing, has_it)) continue;
    ReadingPrediction reading = reading_of(std::string(kind.name), standing);
    if (one) reading.measured = *one;
    reading.of_test = std::max(kind.published_deviation, reading.of_heap);
    out.readings.push_back(std::move(reading));
  }
  return out;
}

}  // namespace pastefit
