#include "calibrate/cli/study_remarks.h"

#include <algorithm>

#include "calibrate/base/text.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/understood.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/description.h"
#include "calibrate/study/coarseness.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

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

/// What has changed since the evaluations were made, and how many of them still hold.
std::string changes_in(const Study& study, const Store& store) {
  if (store.changes().empty()) return "";
  return "Changed since the last run: " + changed_places(store) + ". " +
         std::to_string(earlier_of(study, store).size()) +
         " candidates are known from before within the present bounds; they do not count in the budget.\n";
}

/// What the study weighs or allows of readings that the laboratory did not take.
std::string readings_not_measured(const Study& study) {
  std::string names;
  for (const StudyTest& test : study.tests)
    for (const std::string& name : test.not_measured) names += (names.empty() ? "" : ", ") + reading_name(test, name);
  return names.empty() ? "" : "Weights and tolerances of readings that were not taken are left out: " + names + ".\n";
}

}  // namespace

std::string notes_on_readings(const Study& study) {
  std::string out;
  for (const StudyTest& test : study.tests) {
    if (!test.lab.note.empty()) out += test.lab_file + ": " + test.lab.note + ".\n";
    for (const std::string& note : test.lab.notes) out += test.lab_file + ": " + note + ".\n";
    for (const std::string& note : check_readings(test.lab.test, test.lab.measurements).notes)
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
