#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/batch/batch.h"
#include "calibrate/batch/interpolation.h"
#include "calibrate/card/card.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/output_file.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/summary.h"

namespace pastefit {

namespace {

struct InterpolateArguments {
  std::vector<std::string> studies;
  std::string from, at, model = "linear", out;
  bool force = false;
  bool json = false;
};

/// "mix.water_kg_m3=195"
Result<MixInBetween> mix_of(const InterpolateArguments& options) {
  MixInBetween mix;
  mix.model = options.model == "linear" ? TrendModel::linear : TrendModel::gaussian_process;
  const auto equals = options.at.find('=');
  mix.variable = options.at.substr(0, equals);
  const std::string number = equals == std::string::npos ? "" : options.at.substr(equals + 1);
  std::size_t read = 0;
  try {
    mix.value = std::stod(number, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (read > 0 && read == number.size() && std::isfinite(mix.value)) return mix;
  return Fault{"--at", "is " + in_quotes(options.at), "a variable and its value, as mix.water_kg_m3=180"};
}

int interpolate(const InterpolateArguments& options) {
  Faults faults;
  const auto mix = mix_of(options);
  if (!mix.ok()) faults = mix.faults();
  const auto batch = read_batch(options.studies, options.from);
  if (!batch.ok()) faults.insert(faults.end(), batch.faults().begin(), batch.faults().end());
  if (!options.out.empty())
    for (Fault& fault : output_faults("--out", options.out, options.force)) faults.push_back(std::move(fault));
  if (!faults.empty()) return report(faults);
  const auto card = interpolated_card(batch.value(), mix.value());
  if (!card.ok()) return report(card.faults());
  const auto readable = readable_text(card.value());
  if (!readable.ok()) return report(readable.faults(), kFailed);
  const std::string& card_text = readable.value();
  if (!is_standard_output(options.out)) print("%s", options.json ? card_text.c_str() : text_of(card.value()).c_str());
  if (options.out.empty()) return kDone;
  if (const auto failed = write_output(options.out, card_text); !failed.empty()) return report(failed, kFailed);
  if (!is_stream(options.out)) note("wrote %s\n", options.out.c_str());
  return kDone;
}

}  // namespace

Command add_interpolate(CLI::App& verb) {
  const auto options = std::make_shared<InterpolateArguments>();
  verb.add_option("STUDIES", options->studies, "study files of the batch")->required();
  verb.add_option("--from", options->from, "folder of the batch (its --out)")->required()->type_name("DIR");
  verb.add_option("--at", options->at, "the mix in between: a variable of the laboratory files and its value")
      ->required()
      ->type_name("VARIABLE=VALUE");
  verb.add_option("--model", options->model, "linear or gaussian-process; default: linear")
      ->check(CLI::IsMember({"linear", "gaussian-process"}))
      ->type_name("NAME");
  verb.add_option("--out", options->out, "file for the card; -: standard output")->type_name("FILE");
  verb.add_flag("--force", options->force, "replace FILE");
  verb.add_flag("--json", options->json, "print the card itself");
  return [options] { return interpolate(*options); };
}

}  // namespace pastefit
