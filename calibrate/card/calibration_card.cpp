#include "calibrate/card/calibration_card.h"

#include "calibrate/base/machine.h"
#include "calibrate/base/statistics.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

constexpr double kHoldOutAlarm = 0.05;  // probability of rejecting a correct prediction, all readings of a test

/// Readings that all accepted runs have, with the measurement if there is one.
std::vector<CardReading> card_readings(const Study& study, std::size_t index, const std::vector<Baseline::Run>& all) {
  const StudyTest& test = study.tests[index];
  const std::vector<Baseline::Run> runs = accepted(test.lab.test, all);
  std::vector<CardReading> out;
  for (const auto& reading : runs.at(0).readings.all()) {
    const std::vector<double> values = column_of(runs, reading.name);
    if (values.size() < runs.size()) continue;
    CardReading mean;
    mean.name = reading.name;
    mean.simulated = sample_of(values);
    for (std::size_t i = 0; i < test.lab.measurements.size(); ++i) {
      const auto& measurement = test.lab.measurements[i];
      if (measurement.reading != reading.name) continue;
      mean.measured = measurement.value;
      mean.standard_deviation = measurement.standard_deviation;
      mean.repeats = measurement.repeats;
      mean.weight = test.targets[i].weight;
      mean.tolerance = tolerance_of(study, index, i);
    }
    out.push_back(std::move(mean));
  }
  return out;
}

/// Compares a prediction with the measurement: each reading with a weight, within the noise of both.
void judge(CardTest& test) {
  std::vector<CardReading*> judged;
  for (auto& reading : test.readings)
    if (reading.measured && reading.weight > 0) judged.push_back(&reading);
  const double share = kHoldOutAlarm / static_cast<double>(judged.size());
  test.within_noise = !judged.empty();
  for (auto* reading : judged) {
    const Sample measured{reading->repeats, *reading->measured, reading->standard_deviation};
    reading->band = unequal_band_of(measured, reading->simulated, share);
    test.within_noise = *test.within_noise && lie_within(*reading->band, reading->simulated.mean, measured.mean);
  }
}

CardTest card_test_of(const Study& study, std::size_t index, const std::vector<double>& values, const Response& shown,
                      const Store& store) {
  const auto& test = study.tests[index];
  CardTest out;
  out.name = test.name;
  out.hold_out = test.hold_out;
  out.lab_file = test.lab_file;
  out.lab_hash = test.lab.hash;
  out.lab = test.lab.provenance;
  out.yield_stress = test.lab.yield_stress;
  const auto add_note = [&](const std::string& note) { out.lab.notes += (out.lab.notes.empty() ? "" : "; ") + note; };
  if (!test.lab.note.empty()) add_note(test.lab.note);
  if (test.lab.repeats.sheared > 0) add_note(sheared_in_words(test.lab.repeats));
  out.test = test_with(test.lab.test, values, shown.packings.at(0));
  auto runs = known_runs(study, index, shown.point, shown.packings, store);
  if (runs.empty()) return out;  // not simulated
  out.baseline = {store.identity().program, machine_type(), {}};
  for (std::size_t i = 0; i < runs.size(); ++i) out.baseline.runs.push_back({shown.packings[i], std::move(runs[i])});
  out.readings = card_readings(study, index, out.baseline.runs);
  if (out.hold_out) judge(out);
  return out;
}

/// The study's first test is fitted; the material is stated for its grains.
Material material_of(const Study& study, const std::vector<double>& values, const CardTest& first) {
  const Specimen& specimen = specimen_of(first.test);
  Material material{specimen.bulk_density_kg_m3, {}, specimen.grains, specimen.contact, study.parameters};
  for (std::size_t i = 0; i < values.size(); ++i) material.parameters[i].value = values[i];
  Readings means;
  for (const auto& reading : first.readings) means.set(reading.name, reading.simulated.mean);
  material.grain_density_kg_m3 =
      std::visit([&](const auto& test) { return grain_density_of(test, means); }, first.test);
  return material;
}

}  // namespace

const Response& shown_of(const Calibration& calibration) {
  const bool fresh = calibration.confirmation.point.size() > 0 && !calibration.confirmation.failed;
  return fresh ? calibration.confirmation : calibration.best;
}

Card card_of(const Study& study, const Calibration& calibration, const Store& store, const EvaluationCounts& counts,
             const std::string& study_file) {
  const Response& shown = shown_of(calibration);
  const bool fresh = &shown == &calibration.confirmation;
  const auto values = values_at(study, coordinates(shown.point));

  Card card;
  card.title = study.title;
  for (std::size_t i = 0; i < study.tests.size(); ++i)
    card.tests.push_back(card_test_of(study, i, values, shown, store));
  card.material = material_of(study, values, card.tests.front());

  const double share = rejected_share_of(study);
  const Verdict verdict = verdict_on(evidence_of(shown), share);
  card.confirmation = {shown.packings, fresh, shown.error, fresh && verdict == Verdict::meets,
                       fresh && verdict == Verdict::refuted};
  if (fresh) card.confirmation.rejected_share = share;
  card.search = {
      study.search.strategy,         std::string(name_of(calibration.status)), calibration.reason, study.search.seed,
      calibration.search.packings,   study.search.budget_simulations,          counts.known(),     {},
      calibration.coarse_simulations};
  for (const auto& [reason, count] : counts.failures) card.search.failures[std::string(name_of(reason))] = count;
  card.provenance = {study_file, study.hash, store.identity().program, study.settings};
  return card;
}

}  // namespace pastefit
