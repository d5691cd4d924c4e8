#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/diagnosis.h"
#include "calibrate/report/findings.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

namespace {

struct DoctorArguments {
  std::string place;  ///< folder of a calibration, or a card
  bool json = false;
};

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

int run_doctor(const DoctorArguments& options) {
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

}  // namespace

Command add_doctor(CLI::App& verb) {
  const auto options = std::make_shared<DoctorArguments>();
  verb.add_option("PLACE", options->place, "folder of a calibration, or a card")->required();
  verb.add_flag("--json", options->json, "print the findings as JSON");
  return [options] { return run_doctor(*options); };
}

}  // namespace pastefit
