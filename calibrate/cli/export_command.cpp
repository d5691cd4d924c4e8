#include <filesystem>
#include <memory>

#include "calibrate/base/atomic_file.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/exports/export.h"
#include "calibrate/report/findings.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

namespace fs = std::filesystem;

namespace {

struct ExportOptions {
  std::string card, out, target, test, application;
  std::optional<std::uint64_t> packing;
  bool force = false, unconfirmed = false, materials = false;
};

Result<std::vector<ExportFile>> files_of(const Card& card, const Exporter& exporter, const ExportOptions& options) {
  auto written =
      export_card(card, exporter,
                  {options.card, options.test, options.packing, options.unconfirmed, shown_run(), options.application});
  if (!written.ok()) return written.faults();
  return std::move(written).value().files;
}

/// Every material that fits, each with its card in a folder of its own. All but the first are not confirmed.
Result<std::vector<ExportFile>> files_of_materials(const Exporter& exporter, ExportOptions options) {
  const auto found = read_fitting_materials(fs::path(options.card).parent_path(), kStore);
  if (!found.ok()) return found.faults();
  const auto& [own, materials] = found.value();
  std::vector<ExportFile> all;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const std::string folder = format("material-%zu", k + 1);
    Card card = k == 0 ? own : with_other_material(own, materials[k]);
    card.title += format(", material %zu of %zu that fit", k + 1, materials.size());
    options.card = (fs::path(options.out) / folder / kCardFile).string();
    options.unconfirmed = options.unconfirmed || k > 0;
    const auto text = readable_text(card);
    auto files = files_of(card, exporter, options);
    if (!text.ok()) return text.faults();
    if (!files.ok()) return files.faults();
    all.push_back({folder + "/" + kCardFile, text.value()});
    for (ExportFile& one : files.value()) all.push_back({folder + "/" + one.name, std::move(one.content)});
  }
  return all;
}

int export_to_folder(const ExportOptions& options) {
  Faults faults;
  const auto exporter = exporter_named(options.target);
  append(faults, exporter);
  const auto card = read_card(options.card);
  append(faults, card);
  append(faults, output_folder_faults("--out", options.out));
  if (!exporter.ok() || !card.ok()) refuse(faults);
  const auto written = options.materials ? files_of_materials(exporter.value(), options)
                                         : files_of(card.value(), exporter.value(), options);
  append(faults, written);
  refuse(faults);
  const std::vector<ExportFile>& files = written.value();

  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.name);
  const auto folder = value_or_throw(
      OutputFolder::open(options.out, names, options.force ? EarlierResult::replace : EarlierResult::refuse, kSpace));
  for (const auto& file : files) {
    std::error_code ignored;  // the error shows up on writing
    fs::create_directories(folder.file(file.name).parent_path(), ignored);
    refuse(write_atomically(folder.file(file.name), file.content), kFailed);
  }
  for (const auto& file : files) print("wrote %s\n", folder.file(file.name).c_str());
  print("%s", files.back().content.c_str());
  return kDone;
}

}  // namespace

Command add_export(CLI::App& verb) {
  const auto options = std::make_shared<ExportOptions>();
  verb.add_option("CARD", options->card, "card file")->required();
  std::string targets;
  for (const auto& one : exporters()) targets += (targets.empty() ? "target: " : ", ") + std::string(one.name);
  verb.add_option("--to", options->target, targets)->required()->type_name("TARGET");
  verb.add_option("--out", options->out, "folder for the files")->required()->type_name("DIR");
  verb.add_option("--test", options->test,
                  "test of the card to write; default: the first that has a deck, or else the first")
      ->type_name("NAME");
  verb.add_option("--packing", options->packing, "seed of the random packing; default: that of the test")
      ->check(whole_number());
  verb.add_option("--application", options->application,
                  "machine in which to simulate the material, in place of the test: chute, hopper, mixer, or a file of your own")
      ->type_name("FILE");
  verb.add_flag("--unconfirmed", options->unconfirmed, "export an unconfirmed card, marked in every file");
  verb.add_flag("--materials", options->materials,
                "every material that fits the readings, each in a folder of its own; CARD in the folder of its "
                "calibration");
  verb.add_flag("--force", options->force, "replace an earlier export in DIR");
  return [options] { return export_to_folder(*options); };
}

}  // namespace pastefit
