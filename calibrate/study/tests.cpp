#include "calibrate/study/tests.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/schemas.h"

namespace pastefit {

namespace {

using nlohmann::json;

constexpr std::size_t most_tests = 20;
constexpr Range weights{0, 1e6}, tolerances{1e-6, 1e6};

/// Reads an object with numbers for some readings; `set` stores each in the reading's target. Readings that the
/// apparatus has, but that were not measured, go to `not_measured`. If the laboratory file could not be read, all known
/// readings are allowed.
void read_numbers(ObjectReader& reader, StudyTest& test, const Range& range, auto set) {
  const Lab& lab = test.lab;
  std::vector<Target>& targets = test.targets;
  const bool unread = lab.measurements.empty();
  for (const ReadingKind& kind : unread ? all_reading_kinds() : reading_kinds(lab.test)) {
    if (kind.key.empty()) continue;
    const auto target = std::ranges::find(targets, kind.measure, &Target::reading);
    double number = 0;
    if (target == targets.end() && !unread && kind.lack) {
      reader.refuse(kind.key, "the laboratory file has no such measurement: " + std::string(kind.lack->what),
                    "leave it out");
      continue;
    }
    if (!reader.number(kind.key, number, range, Need::optional)) continue;
    if (target != targets.end())
      set(*target, number);
    else if (!unread && std::ranges::count(test.not_measured, kind.key) == 0)
      test.not_measured.emplace_back(kind.key);
  }
}

/// "weights" and "tolerances".
void read_targets(ObjectReader& document, StudyTest& test) {
  std::vector<Target>& targets = test.targets;
  for (const Measurement& measurement : test.lab.measurements) targets.push_back({measurement.reading, 1});
  document.object("weights", Need::optional, [&](ObjectReader& reader) {
    read_numbers(reader, test, weights, [](Target& target, double weight) { target.weight = weight; });
    if (!targets.empty() && std::ranges::all_of(targets, [](const Target& target) { return target.weight == 0; }))
      document.fault("weights", test.hold_out ? "all are 0, so nothing is judged" : "all are 0, so nothing is fitted",
                     "give at least one measurement a weight above 0");
  });
  document.object("tolerances", Need::optional, [&](ObjectReader& reader) {
    read_numbers(reader, test, tolerances, [](Target& target, double tolerance) { target.tolerance = tolerance; });
  });
}

/// Reads the name, or the content, of a laboratory file.
void read_lab_of(ObjectReader& reader, const LabReading& labs, StudyTest& test) {
  const json* given = reader.content("lab");
  const bool in_place = given && given->is_object();
  reader.known("lab");
  if (in_place) test.lab_file = "in the study";
  if (!in_place && !reader.text("lab", test.lab_file, Need::required)) return;
  const auto change = [&](json& lab) {
    if (labs.change) labs.change(lab, test);
  };
  const auto read_in_place = [&]() -> Result<Lab> {
    json document = *given;
    change(document);
    auto lab = lab_from_json(document, labs.folder);
    return lab.ok() ? std::move(lab) : in_file(lab.faults(), reader.place("lab"));
  };
  Result<Lab> read = in_place ? read_in_place() : read_lab((labs.folder / test.lab_file).lexically_normal(), change);
  if (auto lab = value_or_append(std::move(read), labs.faults)) test.lab = std::move(*lab);
}

/// Names are used before a slash in reading names, and in one line of a table.
bool is_name(const std::string& name) {
  return !name.empty() && name.size() <= 40 && std::ranges::all_of(name, [](unsigned char letter) {
    return std::isalnum(letter) || letter == '-' || letter == '_' || letter == '.';
  });
}

/// `test`: of `tests`, as the last one so far.
void read_one_of_many(ObjectReader& reader, const LabReading& labs, const std::vector<StudyTest>& tests,
                      StudyTest& test) {
  if (reader.text("name", test.name, Need::required)) {
    if (!is_name(test.name)) reader.fault("name", in_quotes(test.name), "up to 40 letters, digits, '-', '_' and '.'");
    if (std::ranges::count(tests, test.name, &StudyTest::name) > 1)
      reader.fault("name", in_quotes(test.name) + " is the name of two tests", "a name of its own for each");
  }
  reader.flag("hold_out", test.hold_out, Need::optional);
  read_lab_of(reader, labs, test);
  read_targets(reader, test);
}

}  // namespace

std::vector<std::size_t> tests_of(const Study& study, bool hold_out) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < study.tests.size(); ++i)
    if (study.tests[i].hold_out == hold_out) out.push_back(i);
  return out;
}

std::vector<StudyReading> readings_of(const Study& study) {
  std::vector<StudyReading> out;
  for (const std::size_t i : tests_of(study, false)) {
    const StudyTest& test = study.tests[i];
    for (std::size_t k = 0; k < test.lab.measurements.size(); ++k)
      out.push_back({i, reading_name(test, test.lab.measurements[k].reading), test.lab.measurements[k],
                     test.targets.at(k).weight, tolerance_of(study, i, k)});
  }
  return out;
}

std::vector<StudyTest> read_tests(ObjectReader& document, const LabReading& labs) {
  std::vector<StudyTest> tests;
  if (!document.has("tests")) {
    StudyTest& only = tests.emplace_back();
    read_lab_of(document, labs, only);
    read_targets(document, only);
    return tests;
  }
  document.refuse("lab", "stands beside \"tests\"", "name the laboratory file in the tests");
  document.refuse("weights", "stand beside \"tests\"", "give each test weights of its own");
  document.refuse("tolerances", "stand beside \"tests\"", "give each test tolerances of its own");
  const json& list = *document.content("tests");
  if (!list.is_array() || list.empty() || list.size() > most_tests) {
    document.refuse("tests", "is not a list of 1 to " + std::to_string(most_tests) + " tests",
                    "[ {\"name\": \"slow\", \"lab\": \"slow.json\"}, ... ]");
    return tests;
  }
  document.list("tests", tests, Need::required,
                [&](ObjectReader& one, StudyTest& test) { read_one_of_many(one, labs, tests, test); });
  std::stable_partition(tests.begin(), tests.end(), [](const StudyTest& test) { return !test.hold_out; });
  if (!tests.empty() && tests.front().hold_out)
    document.fault("tests", "all are held out, so nothing is fitted", "leave \"hold_out\" out in at least one");
  return tests;
}

namespace {

void tell_numbers(ObjectSchema& study, const Key& key, const Range& range) {
  study.object(key, Need::optional, [&](ObjectSchema& numbers) {
    for (const ReadingKind& kind : all_reading_kinds())
      if (!kind.key.empty()) numbers.number(kind.key, 0, range, Need::optional);
  });
}

}  // namespace

void tell_tests(ObjectSchema& study) {
  using Json = ObjectSchema::Json;
  const Json lab{{"type", {"string", "object"}}};
  study.put({"lab", "laboratory file of a study with one test: its path or its content"}, lab, Need::optional);
  const Json test = study.described([&](ObjectSchema& one) {
    one.put({"name", "name of the test; in tables, it precedes the names of the test's readings"},
            {{"type", "string"}, {"pattern", "^[A-Za-z0-9._-]{1,40}$"}}, Need::required);
    one.put({"lab", "laboratory file of the test: its path or its content"}, lab, Need::required);
    one.flag({"hold_out", "true: a validation test, which is predicted and compared but not fitted"}, false,
             Need::optional);
    one.put({"weights", "weights of the readings of this test, in the form of `weights`"},
            {{"$ref", "#/properties/weights"}}, Need::optional);
    one.put({"tolerances", "tolerances of the readings of this test, in the form of `tolerances`"},
            {{"$ref", "#/properties/tolerances"}}, Need::optional);
  });
  study.put({"tests", "the tests of a study that has several; all tests are of one material"},
            {{"type", "array"}, {"minItems", 1}, {"maxItems", most_tests}, {"items", test}}, Need::optional);
  tell_numbers(study,
               {"weights",
                "weights of the measured readings in the fit, by the names of `measurements` in the laboratory file; "
                "default 1; 0: the reading is shown but not fitted"},
               weights);
  tell_numbers(study,
               {"tolerances",
                "largest accepted differences between simulated and measured readings, in the unit of the reading, by "
                "the names of `measurements` in the laboratory file; default: search.tolerance_mm for lengths, and one "
                "standard deviation of the measurement for other readings"},
               tolerances);
}

std::string inputs_of(const Study& study) {
  json inputs;
  inputs["study"] = json::parse(study.content.empty() ? "{}" : study.content);
  inputs["study"].erase("title");
  if (const auto search = inputs["study"].find("search"); search != inputs["study"].end()) {
    search->erase("budget_simulations");
    if (search->empty()) inputs["study"].erase(search);
  }
  for (const StudyTest& test : study.tests) {
    json content = json::parse(test.lab.content.empty() ? "{}" : test.lab.content);
    if (content.contains("laboratory")) {  // what does not affect the search
      content["laboratory"].erase("mix");
      content["laboratory"]["material"].erase("yield_stress_pa");
    }
    inputs["laboratories"].push_back(std::move(content));
  }
  return inputs.dump();
}

Study with_coarse_grains(Study study) {
  for (StudyTest& test : study.tests) {
    if (!why_of_that_size(test.lab.test).empty()) continue;
    GrainSizes& grains = specimen_of(test.lab.test).grains;
    grains = enlarged(grains, coarse_radius_ratio);
  }
  return study;
}

bool is_length(std::string_view reading) {
  return reading.ends_with("_mm");
}

double tolerance_of(const Study& study, std::size_t test, std::size_t measurement) {
  const StudyTest& one = study.tests.at(test);
  const Measurement& read = one.lab.measurements.at(measurement);
  if (const auto& own = one.targets.at(measurement).tolerance) return *own;
  if (is_length(read.reading) && study.search.tolerance_mm) return *study.search.tolerance_mm;
  return std::visit([&](const auto& kind) { return default_tolerance(kind, read); }, one.lab.test);
}

std::string ErrorUnit::words(double error, const char* pattern) const {
  return format(pattern, of(error)) + " " + name();
}

ErrorUnit error_unit_of(std::span<const std::pair<std::string_view, double>> fitted) {
  const bool in_mm = !fitted.empty() && std::ranges::all_of(fitted, [&](const auto& one) {
    return is_length(one.first) && one.second == fitted.front().second;
  });
  return in_mm ? ErrorUnit{fitted.front().second} : ErrorUnit{};
}

ErrorUnit error_unit_of(const Study& study) {
  const std::vector<StudyReading> readings = readings_of(study);
  std::vector<std::pair<std::string_view, double>> fitted;
  for (const StudyReading& reading : readings)
    if (reading.weight > 0) fitted.emplace_back(reading.measurement.reading, reading.tolerance);
  return error_unit_of(fitted);
}

namespace {

constexpr double kDeviations = 3;

std::string grains_in_words(const Test& test) {
  return "about " + plain(grains_needed(test), 2) + " grains of " +
         format("%g mm", mm * specimen_of(test).grains.radius_m) + " mean radius";
}

}  // namespace

std::string note_on_grain_count(const Test& test) {
  const double count = grains_needed(test);
  const bool is_bed = why_of_that_size(test).empty();  // one body needs no minimum number of grains
  if (!is_bed || count >= kFewGrains) return {};
  const double radius_mm = mm * specimen_of(test).grains.radius_m * std::cbrt(count / kFewGrains);
  return grains_in_words(test) + format(
                                     " fill the apparatus, fewer than %g: heaps of so few grains vary much, and a "
                                     "wrong material may fit the readings; use a mean radius of %.2g mm or less",
                                     kFewGrains, radius_mm);
}

std::vector<std::string> notes_on_tolerances(const Study& study) {
  std::vector<std::string> notes;
  for (const StudyReading& reading : readings_of(study)) {
    const Test& test = study.tests[reading.test].lab.test;
    const auto own_kinds = reading_kinds(test);
    const ReadingKind* kind = find_kind(own_kinds, reading.measurement.reading);
    // The tolerance of a shift comes from the standards' rejection of sheared-off heaps.
    if (reading.weight == 0 || !kind || kind->key.find("lateral_shift") != kind->key.npos) continue;
    const double published = kind->published_deviation;
    const double measured = reading.measurement.standard_deviation;
    const double deviation = published > 0 ? std::min(published, measured) : measured;
    if (reading.tolerance <= kDeviations * deviation) continue;
    notes.push_back(
        reading.name + " counts as met within " + plain(reading.tolerance) +
        format(", which is %.1f standard deviations (%s) of the ", reading.tolerance / deviation,
               plain(deviation, 2).c_str()) +
        (deviation < measured ? "published repeatability" : "laboratory") + ", with " + grains_in_words(test) +
        ": a wrong material may fit; give a smaller tolerance, or smaller grains if their radius sets the tolerance");
  }
  return notes;
}

}  // namespace pastefit
