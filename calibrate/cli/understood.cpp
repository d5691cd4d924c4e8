#include "calibrate/cli/understood.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/description.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

std::string grains_in_words(const Test& test) {
  const GrainSizes& grains = specimen_of(test).grains;
  const double count = grains_needed(test);
  const std::string size = grains.distribution == SizeDistribution::mono
                               ? format("%g mm radius", mm * grains.radius_m)
                               : format("%g to %g mm radius", mm * grains.smallest_m, mm * grains.largest_m);
  return count < 2 ? "one of " + size : "about " + plain(count, 2) + " of " + size;
}

std::string unit_at_end(std::string_view reading) {
  const auto unit = unit_of_key(reading);
  return unit ? " " + std::string(unit->name) : "";
}

/// "step1.height_mm 137.5 within 7.5 mm".
std::string readings_to_be_met(const Study& study) {
  std::string out;
  for (const StudyReading& reading : readings_of(study)) {
    if (reading.weight == 0) continue;
    out += format("  %-24s %s", reading.name, plain(reading.measurement.value, 5)) + " within " +
           plain(reading.tolerance) + unit_at_end(reading.measurement.reading) + "\n";
  }
  return out;
}

/// Run time [s] of one simulation of the test on this machine: measured with few, coarse grains, and scaled, since the
/// number of grains goes with 1/R^3 and that of steps with 1/R. Nothing if that simulation fails.
std::optional<double> seconds_of_simulation(const Test& test) {
  constexpr double few = 300;  // grains
  constexpr double largest_factor = 30, patience_s = 2;
  Test coarse = test;
  // As coarse as the apparatus permits.
  double factor = std::clamp(std::cbrt(grains_needed(test) / few), 1.0, largest_factor);
  for (;; factor = std::max(1.0, 0.9 * factor)) {
    specimen_of(coarse).grains = enlarged(specimen_of(test).grains, factor);
    if (validate(coarse).empty()) break;
    if (factor == 1) return std::nullopt;
  }
  RunOptions options;
  options.steps.energy_balance = false;
  const double start_s = thread_seconds();
  const auto taken_s = [&] { return thread_seconds() - start_s; };
  options.pulse = [&](const Snapshot&) { return taken_s() < patience_s; };
  if (simulate(coarse, options).failure) return std::nullopt;
  return taken_s() * std::pow(factor, 4);
}

std::string time_expected(const Study& study, int threads) {
  const SearchOptions& search = study.search;
  double one_s = 0;
  int tests = 0;
  for (const std::size_t test : tests_of(study, false)) {
    const auto seconds = seconds_of_simulation(study.tests[test].lab.test);
    if (!seconds) return "";
    one_s += *seconds;
    ++tests;
  }
  one_s /= tests;
  const int most = search.budget_simulations;
  const int fewest = std::min((search.screening + search.packings + search.confirmation_packings) * tests, most);
  const int at_once = std::min(threads > 0 ? threads : processors(), most);
  const auto wall_s = [&](int simulations) { return one_s * simulations / at_once; };
  return "  time                     " + range_of_time(wall_s(fewest), wall_s(most)) +
         format(": %d to %d simulations of about %s s, %d at once\n", fewest, most, plain(one_s, 2), at_once);
}

/// Free parameters that no fitted reading identifies.
std::string unseen_parameters(const Study& study) {
  std::vector<std::string_view> free;
  for (const Parameter& parameter : study.parameters)
    if (parameter.free && !parameter.prior) free.push_back(parameter.name);
  std::string out;
  for (const std::size_t i : tests_of(study, false)) {
    std::vector<std::string_view> readings;
    const StudyTest& test = study.tests[i];
    for (std::size_t k = 0; k < test.targets.size(); ++k)
      if (test.targets[k].weight > 0) readings.push_back(test.lab.measurements[k].reading);
    const auto unseen = std::visit([&](const auto& one) { return unseen_by(one, readings, free); }, test.lab.test);
    if (unseen.empty()) return "";
    out = unseen;
  }
  return out + "\n";
}

std::vector<std::string> fitted_readings(const Study& study) {
  std::vector<std::string> names;
  for (const auto& reading : readings_of(study))
    if (reading.weight > 0) names.push_back(reading.name);
  return names;
}

int prior_count(const Study& study) {
  return static_cast<int>(
      std::ranges::count_if(study.parameters, [](const Parameter& parameter) { return parameter.prior.has_value(); }));
}

/// Changes since the evaluations were made, and the number of those still valid.
std::string changes_in(const Study& study, const Store& store) {
  if (store.changes().empty()) return "";
  return "Changed since the last run: " + listed(store.changes()) + ". " +
         std::to_string(earlier_of(study, store).size()) +
         " stored candidates lie within the present bounds; they do not count towards the budget.\n";
}

/// Readings with a weight or tolerance in the study, but without a measurement.
std::string readings_not_measured(const Study& study) {
  std::string names;
  for (const StudyTest& test : study.tests)
    for (const std::string& name : test.not_measured) names += (names.empty() ? "" : ", ") + reading_name(test, name);
  return names.empty() ? "" : "Ignored weights and tolerances, of readings that were not measured: " + names + ".\n";
}

}  // namespace

std::string apparatus_in_words(const Test& test) {
  return conditions_in_words(test) + "  grains                   " + grains_in_words(test) + "\n";
}

std::string understood(const Study& study, int threads) {
  std::string out;
  for (const std::size_t i : tests_of(study, false)) {
    const StudyTest& test = study.tests[i];
    if (!test.name.empty()) out += "Test " + test.name + "\n";
    out += apparatus_in_words(test.lab.test);
  }
  return out + "Fitted readings\n" + readings_to_be_met(study) + time_expected(study, threads) +
         unseen_parameters(study);
}

std::string notes_on_readings(const Study& study) {
  std::string out;
  for (const StudyTest& test : study.tests) {
    if (!test.lab.note.empty()) out += test.lab_file + ": " + test.lab.note + ".\n";
    for (const std::string& note : test.lab.notes) out += test.lab_file + ": " + note + ".\n";
    for (const std::string& note : check_readings(test.lab.test, test.lab.measurements).remarks())
      out += test.lab_file + ": " + note + ".\n";
  }
  for (const std::string& note : notes_on_tolerances(study)) out += "Warning: " + note + ".\n";
  return out;
}

void print_remarks(const Study& study, const Store& store, const std::string& file, int threads) {
  note("%s\n%d free parameters, at most %d simulations, %zu known\n", one_line(study.title).c_str(), free_count(study),
       study.search.budget_simulations, store.size());
  for (const auto& remark : store.remarks()) note("%s: %s.\n", file.c_str(), remark.c_str());
  if (!is_quiet()) note("%s%s", understood(study, threads).c_str(), readings_not_measured(study).c_str());
  note("%s%s%s", notes_on_readings(study).c_str(), changes_in(study, store).c_str(),
       warning_before(free_count(study), prior_count(study), fitted_readings(study)).c_str());
}

}  // namespace pastefit
