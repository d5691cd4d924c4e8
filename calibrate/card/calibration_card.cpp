#include "calibrate/card/calibration_card.h"

#include <algorithm>
#include <cmath>

#include "calibrate/card/machine.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

/// Mean and standard deviation of a reading over the packings; nothing if some packing did not give it.
std::optional<CardObservable> mean_of(const std::string& name, const std::vector<Observables>& runs) {
  CardObservable out;
  out.name = name;
  const auto count = static_cast<double>(runs.size());
  for (const auto& run : runs) {
    const auto value = run.find(name);
    if (!value) return std::nullopt;
    out.simulated += *value / count;
  }
  double squares = 0;
  for (const auto& run : runs) squares += std::pow(*run.find(name) - out.simulated, 2);
  if (runs.size() > 1) out.simulated_standard_deviation = std::sqrt(squares / (count - 1));
  return out;
}

}  // namespace

Card card_of(const Study& study, const Calibration& calibration, const SearchOptions& options, const Store& store,
             const EvaluationCounts& counts, const std::string& study_file, const std::string& lab_file) {
  const bool fresh = calibration.confirmation.point.size() > 0 && !calibration.confirmation.failed;
  const auto& shown = fresh ? calibration.confirmation : calibration.best;
  const auto values = values_at(study, shown.point);

  Card card;
  card.title = study.title;
  card.test = test_with(study, values, shown.packings.at(0));
  card.parameters = study.parameters;
  for (std::size_t i = 0; i < values.size(); ++i) card.parameters[i].value = values[i];

  std::vector<Observables> runs;
  for (const auto packing : shown.packings)
    runs.push_back(store.find(evaluation_key(store.identity(), values, packing)).value().observables);
  card.baseline.program = store.identity().program;
  card.baseline.machine = machine_type();
  for (std::size_t i = 0; i < runs.size(); ++i) card.baseline.runs.push_back({shown.packings[i], runs[i]});
  for (const auto& reading : runs.at(0).all()) {
    auto observable = mean_of(reading.name, runs);
    if (!observable) continue;
    for (std::size_t i = 0; i < study.lab.measurements.size(); ++i) {
      const auto& measurement = study.lab.measurements[i];
      if (measurement.observable != reading.name) continue;
      observable->measured = measurement.value;
      observable->standard_deviation = measurement.standard_deviation;
      observable->repeats = measurement.repeats;
      observable->weight = study.weights[i].weight;
    }
    card.observables.push_back(std::move(*observable));
    if (reading.name == "fill.solid_fraction")
      card.grain_density_kg_m3 = card.test.bulk_density_kg_m3 / card.observables.back().simulated;
  }

  card.confirmation = {shown.packings, fresh, shown.misfit_mm, options.tolerance_mm,
                       fresh && shown.misfit_mm <= options.tolerance_mm};
  card.search = {options.strategy,
                 std::string(name_of(calibration.status)),
                 calibration.reason,
                 options.seed,
                 calibration.search.packings,
                 options.budget_simulations,
                 counts.simulated + counts.answered,
                 {}};
  for (const auto& [reason, count] : counts.failures) card.search.failures[std::string(name_of(reason))] = count;
  card.provenance = {study_file, study.hash, lab_file, study.lab.hash, study.lab.provenance, store.identity().program};
  return card;
}

}  // namespace pastefit
