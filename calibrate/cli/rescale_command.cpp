#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/check/check.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
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

int rescale(const RescaleOptions& options) {
  const Card card = value_or_throw(read_card(options.card));
  if (!options.out.empty()) refuse(output_faults("--out", options.out, options.force));
  const double radius = options.radius_mm / 1e3;
  Card result = value_or_throw(rescaled(card, radius));
  if (options.packings > 0) {
    double effort_s = 0;
    for (const auto& test : result.tests) {
      refuse(validate_memory(test.test, options.check.threads));
      effort_s += options.packings * least_effort_s(test.test);
    }
    refuse(long_run_faults("--radius", format("%d simulations of each test", options.packings), effort_s,
                           options.check.threads, options.force, "larger grains, or fewer --packings"));
    const int simulations = options.packings * static_cast<int>(card.tests.size());
    // The number of grains scales with 1/R^3, that of steps with 1/R.
    note("measuring the bias: %d simulations of each size; the new size takes %.3g times the work\n", simulations,
         std::pow(card.material.grains.radius_m / radius, 4));
    WorkLine line("simulations", 2 * simulations);
    result = value_or_throw(with_measured_bias(card, std::move(result), options.packings, options.check,
                                               counted(CheckEngine::ours(), line)),
                            kFailed);
  }
  deliver_card(result, text_of(result), options.json, options.out);
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
  verb.add_flag("--force", options->force, "replace FILE; start even if it takes more than a day");
  verb.add_flag("--json", options->json, "print the new card itself");
  verb.add_option("--packings", options->packings,
                  "simulations of each size that measure the bias; 0: convert without measuring")
      ->check(whole_number(0, 0) | whole_number(2, 1000))
      ->capture_default_str();
  add_threads(verb, options->check.threads);
  return [options] { return rescale(*options); };
}

}  // namespace pastefit
