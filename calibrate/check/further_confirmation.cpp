#include "calibrate/check/further_confirmation.h"

#include <cmath>

#include "calibrate/base/statistics.h"
#include "calibrate/card/standing.h"
#include "calibrate/check/runs.h"

namespace pastefit {

FurtherConfirmation further_confirmation(const Card& card, const CardTest& test, const Test& simulated,
                                         const EngineRuns& done) {
  FurtherConfirmation out;
  out.engine = done.engine;
  out.program = done.program;
  out.test = test.name;
  out.radius_m = specimen_of(simulated).grains.radius_m;
  for (const auto& run : done.runs) out.packings.push_back(run.packing);
  const auto heaps = accepted(simulated, done.runs);
  out.accepted = static_cast<int>(heaps.size());
  out.ranks = done.ranks;
  out.wall_s = done.wall_s;
  out.core_s = done.core_s;
  CardTest there = test;
  there.observables.clear();
  there.test = simulated;
  there.baseline.runs = done.runs;
  for (const CardObservable& of_card : test.observables) {
    const auto sample = sample_of(column_of(heaps, of_card.name));
    if (sample.count == 0) continue;
    CardObservable observable = of_card;
    observable.simulated = sample.mean;
    observable.simulated_standard_deviation = sample.standard_deviation;
    observable.packings = sample.count;
    const auto error = standard_error(observable), error_of_card = standard_error(of_card);
    FurtherConfirmation::Reading reading{of_card.name, of_card.simulated, sample.mean, sample.standard_deviation, {}};
    if (error && error_of_card) reading.standard_error = std::hypot(*error, *error_of_card);
    out.readings.push_back(std::move(reading));
    there.observables.push_back(std::move(observable));
  }
  if (evidence_of({&there, 1}).readings == 0) return out;
  const Confirmation confirmation = confirmation_by(card, {&there, 1}, out.packings);
  out.misfit = confirmation.misfit;
  out.meets_laboratory = confirmation.meets_laboratory;
  return out;
}

}  // namespace pastefit
