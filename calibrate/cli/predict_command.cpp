#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/check/prediction.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/report/findings.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

struct PredictOptions {
  std::string folder, lab, preset;
  int packings = 4, threads = 0;
  bool force = false, json = false;
};

/// The test that is predicted, and what was measured in it.
struct OtherTest {
  Test test;
  std::vector<Measurement> measured;
};

Result<OtherTest> other_test(const PredictOptions& options, const Card& card) {
  if (!options.lab.empty()) {
    auto lab = read_lab(options.lab);
    if (!lab.ok()) return lab.faults();
    return OtherTest{std::move(lab.value().test), std::move(lab.value().measurements)};
  }
  auto preset = find_preset(options.preset, ".");
  if (!preset.ok()) return preset.faults();
  OtherTest out{std::move(preset.value().test), {}};
  specimen_of(out.test).bulk_density_kg_m3 = card.material.bulk_density_kg_m3;
  return out;
}

std::string prediction_table(const Prediction& found, std::size_t materials) {
  std::string out =
      format("%-26s %9s %15s %15s %8s\n", "Reading", "predicted", "90 % of heaps", "materials", "measured");
  for (const ReadingPrediction& one : found.readings) {
    const auto [least, most] = std::ranges::minmax(one.of_materials);
    const std::string measured = one.measured ? plain(one.measured->value, 3) : "";
    out += format("%-26s %9s %15s %15s %8s%s\n", one.name.c_str(), plain(one.mean, 3).c_str(),
                  (plain(one.lower, 3) + " to " + plain(one.upper, 3)).c_str(),
                  (plain(least, 3) + " to " + plain(most, 3)).c_str(), measured.c_str(), one.is_within() ? "" : " x");
  }
  if (!std::ranges::all_of(found.readings, &ReadingPrediction::is_within)) out += "x: measured outside of the band.\n";
  out += format("%zu materials that fit the readings of the calibration, %d heaps", materials, found.heaps);
  return out + (found.rejected > 0
                    ? format("\n(%d of them left out: a laboratory would repeat such a test).\n", found.rejected)
                    : ".\n");
}

nlohmann::ordered_json prediction_json(const Prediction& found, std::size_t materials) {
  nlohmann::ordered_json out{{"materials", materials},
                             {"heaps", found.heaps},
                             {"rejected", found.rejected},
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

int predict_other(const PredictOptions& options) {
  if (options.lab.empty() == options.preset.empty())
    return report({{"--lab, --preset", "name the test to predict", "give one of them"}});
  const auto findings = read_findings(options.folder, kStore);
  if (!findings.ok()) return report(findings.faults());
  if (!findings.value().card || !findings.value().inference)
    return report({{options.folder,
                    "does not say which materials fit: " + (findings.value().missing.empty()
                                                                ? std::string("there is no inference")
                                                                : one_line(findings.value().missing.front())),
                    "the folder of a calibration that ended with a material"}});
  const Card& card = *findings.value().card;
  const auto other = other_test(options, card);
  if (!other.ok()) return report(other.faults());
  std::vector<std::vector<double>> materials;
  for (const EquivalentMaterial& one : findings.value().inference->family)
    materials.push_back(
        values_at(*findings.value().study, {one.point.data(), static_cast<std::size_t>(one.point.size())}));
  const int simulations = options.packings * static_cast<int>(materials.size());
  const Test test = with_material_of(card, other.value().test);
  if (const auto faults = validate(test); !faults.empty()) return report(faults);
  if (const auto faults = validate_memory(test, options.threads); !faults.empty()) return report(faults);
  if (const auto faults =
          long_run_faults("--packings", format("%d simulations", simulations), simulations * least_effort_s(test),
                          options.threads, options.force, "fewer --packings");
      !faults.empty())
    return report(faults);
  WorkLine line("simulations", simulations);
  const auto found = predict(card, materials, other.value().test, other.value().measured, options.packings,
                             options.threads, counted(CheckEngine::ours(), line));
  line.clear();
  if (!found.ok()) return report(found.faults(), kFailed);
  if (options.json) {
    print("%s", json_text(prediction_json(found.value(), materials.size())).c_str());
  } else {
    const std::string open = unconfirmed_line(card);
    print("%s%s", open.empty() ? "" : (one_line(open) + "\n").c_str(),
          prediction_table(found.value(), materials.size()).c_str());
  }
  return std::ranges::all_of(found.value().readings, &ReadingPrediction::is_within) ? kDone : kFailed;
}

}  // namespace

Command add_predict(CLI::App& verb) {
  const auto options = std::make_shared<PredictOptions>();
  verb.add_option("DIR", options->folder, "folder of a calibration")->required();
  auto* lab =
      verb.add_option("--lab", options->lab, "laboratory file of the test to predict; what it measured is compared")
          ->type_name("LAB");
  verb.add_option("--preset", options->preset, "preset of the test to predict, e.g. hinged-plate")
      ->type_name("PRESET")
      ->excludes(lab);
  verb.add_option("--packings", options->packings, "heaps of each material")
      ->check(whole_number(2, 1000))
      ->capture_default_str();
  add_threads(verb, options->threads);
  verb.add_flag("--force", options->force, "compute for more than a day");
  verb.add_flag("--json", options->json, "print the prediction as JSON");
  return [options] { return predict_other(*options); };
}

}  // namespace pastefit
