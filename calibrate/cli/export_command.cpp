#include <filesystem>
#include <memory>

#include "calibrate/base/atomic_file.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/output_file.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/exports/export.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

namespace {

struct ExportOptions {
  std::string card, out, target, test;
  std::optional<std::uint64_t> packing;
  bool force = false, unconfirmed = false;
};

int export_to_folder(const ExportOptions& options) {
  Faults faults;
  const auto exporter = exporter_named(options.target);
  append(faults, exporter);
  const auto card = read_card(options.card);
  append(faults, card);
  append(faults, output_folder_faults("--out", options.out));
  if (!exporter.ok() || !card.ok()) refuse(faults);
  const auto written = export_card(card.value(), exporter.value(),
                                   {options.card, options.test, options.packing, options.unconfirmed, shown_run()});
  append(faults, written);
  refuse(faults);
  const std::vector<ExportFile>& files = written.value().files;

  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.name);
  const auto folder = value_or_throw(
      OutputFolder::open(options.out, names, options.force ? EarlierResult::replace : EarlierResult::refuse, kSpace));
  for (const auto& file : files) {
    std::error_code ignored;  // the error shows up on writing
    std::filesystem::create_directories(folder.file(file.name).parent_path(), ignored);
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
  verb.add_flag("--unconfirmed", options->unconfirmed, "export an unconfirmed card, marked in every file");
  verb.add_flag("--force", options->force, "replace an earlier export in DIR");
  return [options] { return export_to_folder(*options); };
}

}  // namespace pastefit
