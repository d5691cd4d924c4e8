#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/check/rescale_bias.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/output_file.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/report/summary.h"

namespace pastefit {

namespace {

struct RescaleOptions {
  std::string card, out;
  double radius_mm = 0;
  int packings = 4;
  bool force = false;
  bool json = false;
  CheckOptions check;
};

/// Grains in a full mould go with 1/R^3, steps of time with 1/R.
double work_ratio(double from_m, double to_m) {
  return std::pow(from_m / to_m, 4);
}

int rescale(const RescaleOptions& options) {
  const auto card = read_card(options.card);
  if (!card.ok()) return report(card.faults());
  if (!options.out.empty())
    if (const auto faults = output_faults("--out", options.out, options.force); !faults.empty()) return report(faults);
  const double radius = options.radius_mm / 1e3, old_radius = card.value().material.grains.radius_m;
  auto result = rescaled(card.value(), radius);
  if (!result.ok()) return report(result.faults());
  if (options.packings > 0) {
    for (const auto& test : result.value().tests)
      if (const auto faults = validate_memory(test.test, options.check.threads); !faults.empty()) return report(faults);
    double effort_s = 0;
    for (const auto& test : result.value().tests) effort_s += options.packings * least_effort_s(test.test);
    if (const auto faults =
            long_run_faults("--radius", format("%d simulations of each test", options.packings), effort_s,
                            options.check.threads, options.force, "larger grains, or fewer --packings");
        !faults.empty())
      return report(faults);
    note("measuring the bias: %d simulations with either size, %.3g times the work with the new one\n",
         options.packings * static_cast<int>(card.value().tests.size()), work_ratio(old_radius, radius));
    WorkLine line("simulations", 2 * options.packings * static_cast<int>(card.value().tests.size()));
    result = with_measured_bias(card.value(), std::move(result).value(), options.packings, options.check,
                                counted(CheckEngine::ours(), line));
    if (!result.ok()) return report(result.faults(), kFailed);
  }
  const auto readable = readable_text(result.value());
  if (!readable.ok()) return report(readable.faults(), kFailed);
  const std::string& card_text = readable.value();
  if (!is_standard_output(options.out)) print("%s", options.json ? card_text.c_str() : text_of(result.value()).c_str());
  if (options.out.empty()) return kDone;
  if (const auto faults = write_output(options.out, card_text); !faults.empty()) return report(faults, kFailed);
  if (!is_stream(options.out)) note("wrote %s\n", options.out.c_str());
  return kDone;
}

}  // namespace

Command add_rescale(CLI::App& verb) {
  const auto options = std::make_shared<RescaleOptions>();
  verb.add_option("CARD", options->card, "card file")->required();
  verb.add_option("--radius", options->radius_mm, "mean radius of the new grains in mm")
      ->required()
      ->check(number_from(0.01, 1000))
      ->type_name("MM");
  verb.add_option("--out", options->out, "file for the new card; -: standard output")->type_name("FILE");
  verb.add_flag("--force", options->force, "replace FILE; compute for more than a day");
  verb.add_flag("--json", options->json, "print the new card itself");
  verb.add_option("--packings", options->packings,
                  "simulations with either size that measure the bias; 0: carry over without measuring")
      ->check(whole_number(0, 0) | whole_number(2, 1000))
      ->capture_default_str();
  add_threads(verb, options->check.threads);
  return [options] { return rescale(*options); };
}

}  // namespace pastefit
