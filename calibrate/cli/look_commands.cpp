#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/refusal.h"
#include "calibrate/base/text.h"
#include "calibrate/batch/batch.h"
#include "calibrate/card/standing.h"
#include "calibrate/check/prediction.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/page.h"
#include "calibrate/report/summary.h"
#include "calibrate/study/apparatus.h"

namespace pastefit {

namespace {

struct ShowOptions {
  std::string card;
  bool json = false;
};

int show(const ShowOptions& options) {
  const Card card = value_or_throw(read_card(options.card));
  print(options.json ? json_text(with_yield_stresses(card)) : text_of(card));
  return kDone;
}

struct CompareArguments {
  std::vector<std::string> files;
  bool json = false;
};

int run_compare(const CompareArguments& options) {
  std::vector<CardFile> cards;
  Faults faults;
  for (const std::string& file : options.files)
    if (auto card = value_or_append(read_card(file), faults)) cards.push_back({file, std::move(*card)});
  refuse(std::move(faults));
  print(options.json ? json_text(comparison_json(cards)) : comparison_lines(cards));
  return kDone;
}

struct ReportOptions {
  std::string folder;
  int threads = 0;
  bool quick = false;
};

/// Page of a folder of calibrations.
int write_overview(const std::filesystem::path& folder, const std::vector<BatchRow>& rows) {
  refuse(output_folder_faults("DIR", folder));
  refuse(write_atomically(folder / kPage, batch_page(rows, "Calibrations in " + folder.string())), kFailed);
  print("wrote %s\n", (folder / kPage).c_str());
  return kDone;
}

int write_report(const ReportOptions& options) {
  if (const auto rows = rows_in(options.folder); !rows.empty()) return write_overview(options.folder, rows);
  Findings findings = value_or_throw(read_findings(options.folder));
  const std::filesystem::path folder = options.folder;
  refuse(output_folder_faults("DIR", folder));
  const auto tell = [](const std::string& sentence) { note("pastefit: %s\n", sentence.c_str()); };
  const auto unkept = look_at_tests(findings, folder, listen_for_stop(),
                                    {.threads = options.threads, .simulate = !options.quick, .tell = tell});
  for (const std::string& sentence : findings.missing) note("pastefit: %s\n", one_line(sentence).c_str());
  std::vector<std::string> files{kPage};
  refuse(write_curves(folder, findings, files), kFailed);
  refuse(write_page(folder, findings), kFailed);
  refuse(unkept, kFailed);
  for (const std::string& name : files) print("wrote %s\n", (folder / name).c_str());
  return kDone;
}

struct PredictOptions {
  std::string folder, lab, preset;
  int packings = 4, threads = 0;
  bool force = false, json = false;
};

Test test_of_preset(const std::string& name, const Card& card) {
  Test test = value_or_throw(find_preset(preset_of_standard(name, "."), ".")).test;
  specimen_of(test).bulk_density_kg_m3 = card.material.bulk_density_kg_m3;
  return test;
}

std::string prediction_table(const Prediction& found, std::size_t materials) {
  std::string out =
      format("%-26s %9s %15s %15s %8s\n", "Reading", "predicted", "90 % of heaps", "materials", "measured");
  for (const ReadingPrediction& one : found.readings) {
    const auto [least, most] = std::ranges::minmax(one.of_materials);
    const std::string measured = one.measured ? plain(one.measured->value, 3) : "";
    out += format("%-26s %9s %15s %15s %8s%s\n", one.name, plain(one.mean, 3),
                  plain(one.lower, 3) + " to " + plain(one.upper, 3), plain(least, 3) + " to " + plain(most, 3),
                  measured, one.is_within() ? "" : " x");
  }
  if (!std::ranges::all_of(found.readings, &ReadingPrediction::is_within))
    out += "x: the measured value lies outside the band.\n";
  out += format("%zu materials that fit the readings of the calibration, %d heaps", materials, found.heaps);
  if (found.rejected > 0) out += format("; %d of them sheared off and are left out", found.rejected);
  if (found.failed > 0) out += format("; %d of them never came to rest, or failed, and are left out", found.failed);
  if (found.spilled > 0) out += format("; %d slid off the table and are left out", found.spilled);
  return wrapped(out + ".\n");
}

nlohmann::ordered_json prediction_json(const Prediction& found, std::size_t materials) {
  nlohmann::ordered_json out{{"materials", materials},
                             {"heaps", found.heaps},
                             {"rejected", found.rejected},
                             {"failed", found.failed},
                             {"spilled", found.spilled},
                             {"level", prediction_level},
                             {"readings", nlohmann::ordered_json::object()}};
  for (const ReadingPrediction& one : found.readings) {
    nlohmann::ordered_json& row = out["readings"][one.name];
    row = {{"mean", one.mean},
           {"lower", one.lower},
           {"upper", one.upper},
           {"of_materials", one.of_materials},
           {"standard_deviation_of_heap", one.of_heap}};
    if (one.measured) row["measured"] = one.measured->value;
  }
  return out;
}

/// Candidates for the next measurement.
struct NextTests {
  std::vector<std::pair<std::string, ReadingPrediction>> readings;  ///< of presets, most discriminating first
  std::vector<std::pair<std::string, std::string>> left_out;        ///< presets, and the reason
};

constexpr double worth_taking = 0.7;  // largest remaining width for which a test is worthwhile

std::string next_table(const NextTests& next) {
  std::string out = format("%-18s %-26s %17s %11s\n", "Measure next", "reading", "materials", "width left");
  bool any = false;
  for (const auto& [preset, one] : next.readings) {
    if (one.width_left() > worth_taking) continue;
    const auto [least, most] = std::ranges::minmax(one.of_materials);
    out += format("%-18s %-26s %17s %9.0f %%\n", preset, one.name, plain(least, 3) + " to " + plain(most, 3),
                  100 * one.width_left());
    any = true;
  }
  if (!any) out = "No preset distinguishes between the materials that fit: their readings hardly differ.\n";
  for (const auto& [preset, why] : next.left_out) out += "Not predicted: " + preset + ", " + why + ".\n";
  return out;
}

nlohmann::ordered_json next_json(const NextTests& next) {
  nlohmann::ordered_json out{{"readings", nlohmann::ordered_json::array()},
                             {"left_out", nlohmann::ordered_json::object()}};
  for (const auto& [preset, one] : next.readings)
    out["readings"].push_back({{"preset", preset},
                               {"reading", one.name},
                               {"of_materials", one.of_materials},
                               {"standard_deviation_of_test", one.of_test},
                               {"width_left", one.width_left()}});
  for (const auto& [preset, why] : next.left_out) out["left_out"][preset] = why;
  return out;
}

/// Heaps of one test.
int simulations_of(const FittingMaterials& family, const PredictOptions& options) {
  return options.packings * static_cast<int>(family.values.size());
}

/// Refuses tests that cannot be predicted, or take too long.
void check_effort(const FittingMaterials& family, const Test& other, const PredictOptions& options, int tests = 1) {
  const Test test = with_material_of(family.card, other);
  refuse(validate(test));
  refuse(validate_memory(test, options.threads));
  const int simulations = tests * simulations_of(family, options);
  refuse(long_run_faults("--packings", format("%d simulations", simulations), simulations * least_effort_s(test),
                         options.threads, options.force, "fewer --packings"));
}

/// Predicts the readings of each preset, and their discrimination between the materials.
int predict_presets(const FittingMaterials& family, const PredictOptions& options) {
  NextTests next;
  std::vector<std::pair<std::string, Test>> tests;
  for (const std::string& name : preset_names(".")) {
    const Test test = test_of_preset(name, family.card);
    const auto same = std::ranges::find(tests, to_json(test), [](const auto& one) { return to_json(one.second); });
    if (same != tests.end())
      same->first = name;  // second name of the same apparatus
    else if (const auto faults = validate(with_material_of(family.card, test)); !faults.empty())
      next.left_out.emplace_back(name, faults.front().where + " " + faults.front().what);
    else
      tests.emplace_back(name, test);
  }
  const int count = static_cast<int>(tests.size());
  for (const auto& [name, test] : tests) check_effort(family, test, options, count);
  WorkLine line("simulations", count * simulations_of(family, options));
  const CheckEngine engine = counted(CheckEngine::ours(), line);
  for (const auto& [name, test] : tests) {
    const auto found = predict(family.card, family.values, test, {}, options.packings, options.threads, engine);
    if (!found.ok()) next.left_out.emplace_back(name, found.faults().front().what);
    if (!found.ok()) continue;
    for (const ReadingPrediction& one : found.value().readings) next.readings.emplace_back(name, one);
  }
  line.clear();
  std::ranges::stable_sort(next.readings, {}, [](const auto& one) { return one.second.width_left(); });
  const std::string open = unconfirmed_line(family.card);
  print(options.json ? json_text(next_json(next))
                     : wrapped((open.empty() ? "" : one_line(open) + "\n") + next_table(next)));
  return kDone;
}

int predict_other(const PredictOptions& options) {
  const FittingMaterials family = value_or_throw(read_fitting_materials(options.folder));
  if (options.lab.empty() && options.preset.empty()) return predict_presets(family, options);
  std::optional<Lab> lab;
  if (!options.lab.empty()) lab = value_or_throw(read_lab(options.lab));
  const Test test = lab ? lab->test : test_of_preset(options.preset, family.card);
  check_effort(family, test, options);
  WorkLine line("simulations", simulations_of(family, options));
  const Prediction found =
      value_or_throw(predict(family.card, family.values, test, lab ? lab->measurements : std::vector<Measurement>(),
                             options.packings, options.threads, counted(CheckEngine::ours(), line)),
                     kFailed);
  line.clear();
  const std::size_t materials = family.values.size();
  if (options.json) {
    print(json_text(prediction_json(found, materials)));
  } else {
    const std::string open = unconfirmed_line(family.card);
    print((open.empty() ? "" : wrapped(one_line(open) + "\n")) + prediction_table(found, materials));
  }
  return std::ranges::all_of(found.readings, &ReadingPrediction::is_within) ? kDone : kFailed;
}

}  // namespace

Command add_show(CLI::App& verb) {
  const auto options = std::make_shared<ShowOptions>();
  verb.add_option("CARD", options->card, "card file")->required();
  verb.add_flag("--json", options->json,
                "print the card as JSON, in the format of this version, with the yield stresses of its readings");
  return [options] { return show(*options); };
}

Command add_compare(CLI::App& verb) {
  const auto options = std::make_shared<CompareArguments>();
  constexpr int least = 2, most = 1000;
  verb.add_option("CARD", options->files, "card files, at least two")->required()->expected(least, most);
  verb.add_flag("--json", options->json, "print the numbers as JSON");
  return [options] { return run_compare(*options); };
}

Command add_report(CLI::App& verb) {
  const auto options = std::make_shared<ReportOptions>();
  verb.add_option("DIR", options->folder, "folder of a finished or running calibration, or of several")->required();
  verb.add_flag("--quick", options->quick, "do not simulate a missing animation or missing heaps");
  add_threads(verb, options->threads);
  return [options] { return write_report(*options); };
}

Command add_predict(CLI::App& verb) {
  const auto options = std::make_shared<PredictOptions>();
  verb.add_option("DIR", options->folder, "folder of a calibration")->required();
  auto* lab =
      verb.add_option("--lab", options->lab, "laboratory file of the test to predict; its readings are compared")
          ->type_name("LAB");
  verb.add_option("--preset", options->preset,
                  "preset of the test to predict, e.g. hinged-plate; without it and --lab: all presets")
      ->type_name("PRESET")
      ->excludes(lab);
  verb.add_option("--packings", options->packings, "heaps per material")
      ->check(whole_number(2, 1000))
      ->capture_default_str();
  add_threads(verb, options->threads);
  verb.add_flag("--force", options->force, "start even if it takes more than a day");
  verb.add_flag("--json", options->json, "print the prediction as JSON");
  return [options] { return predict_other(*options); };
}

}  // namespace pastefit
