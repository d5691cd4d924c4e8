#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/fault_text.h"
#include "calibrate/base/foreign_text.h"
#include "calibrate/base/format.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/option_checks.h"
#include "calibrate/cli/output_folder.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/exports/export.h"

namespace pastefit {

namespace {

struct ExportOptions {
  std::string card, out, target, test;
  std::optional<std::uint64_t> packing;
  bool force = false;
};

const std::string kNotes = "NOTES.txt";

/// Which of the card's tests was written, where there are several.
std::string choice_text(const Card& card, const CardTest& chosen) {
  std::string others;
  for (const auto& test : card.tests)
    if (test.name != chosen.name) others += (others.empty() ? "" : ", ") + test.name;
  if (others.empty()) return {};
  return "This is the card's test " + chosen.name + ". The card has others: " + others +
         " (pastefit export --test NAME).\n\n";
}

/// The heap to expect, and the command that compares that of the other program with it.
std::string comparison_text(const ExportOptions& options, const Card& card, const CardTest& test,
                            const std::string& heap) {
  std::string out;
  const auto packings = card.confirmation.packings.size();
  if (packings >= 1 && !test.observables.empty()) {
    out += packings == 1
               ? "\nThe heap to expect (one packing, error unknown):\n"
               : format("\nThe heap to expect (mean +- standard deviation of the card's %zu packings):\n", packings);
    for (const CardObservable& reading : test.observables)
      out += format("    %-28s %10.5g", reading.name.c_str(), reading.simulated) +
             (reading.packings == 1 ? "\n" : format(" +- %.2g\n", reading.simulated_standard_deviation));
  }
  out += "\nTo compare the heap of the deck with the card's, in this folder:\n    pastefit read " + heap + " --card " +
         std::filesystem::absolute(options.card).string();
  if (!options.test.empty()) out += " --test " + options.test;
  if (options.packing) out += " --packing " + std::to_string(*options.packing);
  return out + "\n";
}

/// What another law in place of the card's does to the heap, and how to do without it.
std::string bias_text(const Export& written) {
  if (written.own_law.empty()) return {};
  std::string out = "\nAnother law than the card's is written, so expect another heap.\n";
  if (!written.heap.empty())
    out +=
        "To measure by how much: run the deck in three or more packings (pastefit export with --packing 1, 2, 3)\n"
        "and compare each heap by the command at the end; the mean difference is the bias of the law.\n";
  return out + "To have none: calibrate with a law that this program has, in the study\n    " + written.own_law + "\n";
}

std::string notes_text(const ExportOptions& options, const Exporter& exporter, const Card& card, const CardTest& test,
                       const Export& written) {
  std::string out = one_line(title_of(card, test)) + "\n" + std::string(exporter.meaning) + "\n\n" +
                    lines_of(choice_text(card, test));
  out += written.notes.empty() ? "Nothing of the card's contact laws is lost.\n" : "What is lost or changed:\n";
  for (const auto& note : written.notes) out += "- " + note + "\n";
  if (!written.instructions.empty()) out += "\nTo run it:\n" + written.instructions;
  out += lines_of(bias_text(written));
  if (!written.heap.empty()) out += lines_of(comparison_text(options, card, test, written.heap));
  return out;
}

int export_to_folder(const ExportOptions& options) {
  Faults faults;
  const auto known = exporters();
  const auto exporter = std::ranges::find(known, options.target, &Exporter::name);
  if (exporter == known.end()) {
    std::set<std::string, std::less<>> names;
    std::string list;
    for (const auto& one : known) {
      names.emplace(one.name);
      list += (list.empty() ? "" : ", ") + std::string(one.name);
    }
    const auto near = nearest(options.target, names);
    faults.push_back({"--to " + options.target, "is no target of an export",
                      near ? "did you mean '" + *near + "'?" : "one of " + list});
  }
  const auto card = read_card(options.card);
  if (!card.ok()) faults.insert(faults.end(), card.faults().begin(), card.faults().end());
  for (Fault& fault : output_folder_faults("--out", options.out)) faults.push_back(std::move(fault));
  if (!faults.empty()) return report(faults);

  const auto test = test_to_export(card.value(), options.test);
  if (!test.ok()) return report(test.faults());
  const auto scene = export_scene(card.value(), test.value(), options.packing);
  if (!scene.ok()) return report(scene.faults(), kFailed);
  const auto written = exporter->write(scene.value());
  if (!written.ok()) return report(written.faults());

  std::vector<std::string> names{kNotes};
  for (const auto& file : written.value().files) names.push_back(file.name);
  const auto folder =
      OutputFolder::open(options.out, names, options.force ? EarlierResult::replace : EarlierResult::refuse, kSpace);
  if (!folder.ok()) return report(folder.faults());
  auto files = written.value().files;
  files.push_back({kNotes, notes_text(options, *exporter, card.value(), test.value(), written.value())});
  for (const auto& file : files) {
    std::error_code ignored;  // what cannot be made cannot be written into
    std::filesystem::create_directories(folder.value().file(file.name).parent_path(), ignored);
    if (const auto unwritten = write_atomically(folder.value().file(file.name), file.content); !unwritten.empty())
      return report(unwritten, kFailed);
  }
  for (const auto& file : files) print("wrote %s\n", folder.value().file(file.name).c_str());
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
                  "the card's test to write; without it the first that has a deck, or else the first")
      ->type_name("NAME");
  verb.add_option("--packing", options->packing, "seed of the random packing; without it the test's own")
      ->check(whole_number());
  verb.add_flag("--force", options->force, "replace an earlier export in DIR");
  return [options] { return export_to_folder(*options); };
}

}  // namespace pastefit
