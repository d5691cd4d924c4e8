#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/refusal.h"
#include "calibrate/base/text.h"
#include "calibrate/batch/batch.h"
#include "calibrate/card/standing.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/comparison.h"
#include "calibrate/report/diagnosis.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/page.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

namespace {

struct ShowOptions {
  std::string place;  ///< a card, or the folder of a calibration
  bool json = false;
};

int show(const ShowOptions& options) {
  const Card card = value_or_throw(read_card(options.place));
  print("%s", (options.json ? json_text(with_yield_stresses(card)) : text_of(card)).c_str());
  return kDone;
}

struct CompareArguments {
  std::vector<std::string> files;
  bool json = false;
};

int run_compare(const CompareArguments& options) {
  std::vector<CardFile> cards;
  Faults faults;
  for (const std::string& file : options.files) {
    auto card = read_card(file);
    append(faults, card);
    if (card.ok()) cards.push_back({file, std::move(card).value()});
  }
  refuse(std::move(faults));
  print("%s", options.json ? json_text(comparison_json(cards)).c_str() : comparison_lines(cards).c_str());
  return kDone;
}

/// Card and simulations of a folder; a card alone has no simulations.
Findings findings_at(const std::string& place) {
  std::error_code error;
  Findings findings;
  if (!std::filesystem::is_directory(place, error)) {
    findings.card = value_or_throw(read_card(place));
    return findings;
  }
  findings = value_or_throw(read_findings(place, kStore));
  if (!findings.card)
    refuse({{place, "has no card to examine: " + one_line(findings.missing.front()),
             "pastefit calibrate STUDY --out " + shell_word_if_needed(place) + " --resume"}});
  return findings;
}

int run_doctor(const ShowOptions& options) {
  const Findings findings = findings_at(options.place);
  const Card& card = *findings.card;
  const auto diagnoses = diagnoses_of(card, findings.evaluations);
  const auto doubtful = std::ranges::count_if(diagnoses, &Diagnosis::is_doubtful);
  if (options.json) {
    print("%s", json_text({{"confirmed", cause_unconfirmed(card).empty()},
                           {"doubtful", doubtful},
                           {"diagnoses", diagnosis_json(diagnoses)},
                           {"missing", findings.missing}})
                    .c_str());
    return doubtful == 0 ? kDone : kFailed;
  }
  if (const std::string open = unconfirmed_line(card); !open.empty()) print("%s\n", wrapped(one_line(open)).c_str());
  print("%s", diagnosis_lines(diagnoses).c_str());
  for (const std::string& one : findings.missing) print("%s\n", wrapped(one_line(one)).c_str());
  print("%td of %zu doubtful. The pages are those of the manual.\n", doubtful, diagnoses.size());
  return doubtful == 0 ? kDone : kFailed;
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
  Findings findings = value_or_throw(read_findings(options.folder, kStore));
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

}  // namespace

Command add_show(CLI::App& verb) {
  const auto options = std::make_shared<ShowOptions>();
  verb.add_option("CARD", options->place, "card file")->required();
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

Command add_doctor(CLI::App& verb) {
  const auto options = std::make_shared<ShowOptions>();
  verb.add_option("PLACE", options->place, "folder of a calibration, or a card")->required();
  verb.add_flag("--json", options->json, "print the findings as JSON");
  return [options] { return run_doctor(*options); };
}

Command add_report(CLI::App& verb) {
  const auto options = std::make_shared<ReportOptions>();
  verb.add_option("DIR", options->folder, "folder of a finished or running calibration, or of several")->required();
  verb.add_flag("--quick", options->quick, "do not simulate a missing animation or missing heaps");
  add_threads(verb, options->threads);
  return [options] { return write_report(*options); };
}

}  // namespace pastefit
