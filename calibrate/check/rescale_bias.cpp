#include <cmath>
#include <numeric>

#include "calibrate/base/statistics.h"
#include "calibrate/card/standing.h"
#include "calibrate/check/check.h"

namespace pastefit {

Result<Card> with_measured_bias(const Card& before, Card after, int count, const CheckOptions& options,
                                const CheckEngine& engine) {
  // Packings not used by any search, whose seeds are small or derived from its own seed.
  std::vector<std::uint64_t> packings(static_cast<std::size_t>(count));
  std::iota(packings.begin(), packings.end(), 70'001);
  for (std::size_t t = 0; t < after.tests.size(); ++t) {
    const CardTest& old_test = before.tests[t];
    CardTest& test = after.tests[t];
    auto old_runs = baseline_runs(old_test.test, heading_of(old_test), packings, engine, options.threads);
    if (!old_runs.ok()) return old_runs.faults();
    auto runs = baseline_runs(test.test, heading_of(test), packings, engine, options.threads);
    if (!runs.ok()) return runs.faults();

    const auto old_accepted = accepted(old_test.test, old_runs.value());
    const auto now_accepted = accepted(test.test, runs.value());
    test.readings.clear();
    for (const auto& [name, value] : runs.value()[0].readings.all()) {
      const auto old_sample = sample_of(column_of(old_accepted, name));
      const auto sample = sample_of(column_of(now_accepted, name));
      CardReading reading;
      for (const auto& known : old_test.readings)
        if (known.name == name) reading = known;
      reading.name = name;
      reading.band.reset();
      reading.simulated = sample;
      test.readings.push_back(std::move(reading));
      after.rescaled.back().bias.push_back({reading_name(test, name), old_sample.mean, sample.mean,
                                            std::hypot(old_sample.standard_deviation / std::sqrt(old_sample.count),
                                                       sample.standard_deviation / std::sqrt(sample.count))});
    }
    test.baseline = {engine.program, engine.machine, std::move(runs).value()};
  }
  after.confirmation = confirmation_by(after, after.tests, packings);
  return after;
}

FurtherConfirmation further_confirmation(const Card& card, const CardTest& test, const Test& simulated,
                                         const std::vector<Baseline::Run>& runs, FurtherConfirmation done) {
  done.test = test.name;
  done.radius_m = specimen_of(simulated).grains.radius_m;
  for (const auto& run : runs) done.packings.push_back(run.packing);
  const auto heaps = accepted(simulated, runs);
  done.accepted = static_cast<int>(heaps.size());
  CardTest there = test;
  there.readings.clear();
  there.test = simulated;
  there.baseline.runs = runs;
  for (const CardReading& of_card : test.readings) {
    const auto sample = sample_of(column_of(heaps, of_card.name));
    if (sample.count == 0) continue;
    CardReading reading = of_card;
    reading.simulated = sample;
    const auto error = standard_error(reading), error_of_card = standard_error(of_card);
    FurtherConfirmation::Reading beside{
        of_card.name, of_card.simulated.mean, sample.mean, sample.standard_deviation, {}};
    if (error && error_of_card) beside.standard_error = std::hypot(*error, *error_of_card);
    done.readings.push_back(std::move(beside));
    there.readings.push_back(std::move(reading));
  }
  if (evidence_of({&there, 1}).readings == 0) return done;
  const Confirmation confirmation = confirmation_by(card, {&there, 1}, done.packings);
  done.error = confirmation.error;
  done.meets_laboratory = confirmation.meets_laboratory;
  return done;
}

}  // namespace pastefit
