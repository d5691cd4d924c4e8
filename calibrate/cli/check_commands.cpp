#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/card/standing.h"
#include "calibrate/check/check.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/diagnosis.h"
#include "calibrate/report/findings.h"
#include "calibrate/verify/verify.h"

namespace pastefit {

namespace {

struct DoctorOptions {
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
  findings = value_or_throw(read_findings(place));
  if (!findings.card)
    refuse({{place, "has no card to examine: " + one_line(findings.missing.front()),
             "pastefit calibrate STUDY --out " + shell_word_if_needed(place) + " --resume"}});
  return findings;
}

int run_doctor(const DoctorOptions& options) {
  const Findings findings = findings_at(options.place);
  const Card& card = *findings.card;
  const auto diagnoses = diagnoses_of(card, findings.evaluations);
  const auto doubtful = std::ranges::count_if(diagnoses, &Diagnosis::is_doubtful);
  if (options.json) {
    print(json_text({{"confirmed", cause_unconfirmed(card).empty()},
                     {"doubtful", doubtful},
                     {"diagnoses", diagnosis_json(diagnoses)},
                     {"missing", findings.missing}}));
    return doubtful == 0 ? kDone : kFailed;
  }
  if (const std::string open = unconfirmed_line(card); !open.empty()) print(wrapped(one_line(open)) + "\n");
  print(diagnosis_lines(diagnoses));
  for (const std::string& one : findings.missing) print(wrapped(one_line(one)) + "\n");
  print("%td of %zu doubtful. The pages are those of the manual.\n", doubtful, diagnoses.size());
  return doubtful == 0 ? kDone : kFailed;
}

struct CheckCommand {
  std::vector<std::string> cards;
  CheckOptions check;
  std::string against, junit, why;
  bool json = false, rebaseline = false, force = false;
  int packings = 0;
};

int rebaseline_all(const CheckCommand& options) {
  std::vector<Card> cards;
  Faults faults;
  if (options.why.empty())
    faults.push_back({"--rebaseline", "has no reason", "add --why TEXT: what changed, and why the change is correct"});
  for (const auto& file : options.cards) {
    auto card = value_or_append(read_card(file), faults);
    if (!card) continue;
    cards.push_back(std::move(card).value());
    append(faults, output_file_faults("--rebaseline", file, true));
  }
  refuse(faults);
  int simulations = 0;
  for (const auto& card : cards)
    simulations += std::max(simulations_to_check(card, {}), options.packings * static_cast<int>(card.tests.size()));
  WorkLine line("simulations", simulations);
  const CheckEngine engine = counted(CheckEngine::ours(), line);
  for (auto& card : cards)
    card = value_or_throw(rebaselined(std::move(card), one_line(options.why), options.packings, options.check, engine),
                          kFailed);
  line.clear();
  for (std::size_t i = 0; i < cards.size(); ++i) {
    refuse(write_card(options.cards[i], cards[i]), kFailed);
    const auto packings = cards[i].tests.front().baseline.runs.size();  // same number for every test
    print("%s: new baseline of %zu packings\n", options.cards[i].c_str(), packings);
    for (const auto& moved : cards[i].rebaselined.back().moved)
      print("  %-26s %12.6g -> %.6g\n", moved.reading.c_str(), moved.before, moved.after);
  }
  return kDone;
}

/// 0: all agree, 1: a card disagrees, 2: none disagrees, but some could not be checked.
int status_of(const std::vector<CheckedFile>& checked) {
  const auto any = [&](CheckVerdict verdict) {
    return std::ranges::any_of(checked, [&](const auto& one) { return one.check.verdict == verdict; });
  };
  if (any(CheckVerdict::disagrees)) return kFailed;
  return any(CheckVerdict::not_checked) ? kBadInput : kDone;
}

int check_all(const CheckCommand& options) {
  if (!options.junit.empty()) refuse(output_faults("--junit", options.junit, options.force));
  std::optional<Lab> lab;
  if (!options.against.empty()) lab = value_or_throw(read_lab(options.against));
  std::vector<Result<Card>> cards;
  int simulations = 0;
  for (const auto& file : options.cards) {
    cards.push_back(read_card(file));
    if (!cards.back().ok()) continue;
    const Card& card = cards.back().value();
    simulations += lab ? simulations_to_check_against(card, options.check) : simulations_to_check(card, options.check);
  }
  WorkLine line("simulations", simulations);
  const CheckEngine engine = counted(CheckEngine::ours(), line);
  std::vector<CheckedFile> checked;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    CheckedFile one{options.cards[i], {}};
    const auto start = std::chrono::steady_clock::now();
    const Result<Card>& card = cards[i];
    if (!card.ok()) {
      one.check.card = "unreadable card";
      one.check.reason = message_of(card.faults());
    } else {
      one.check =
          lab ? check_against(card.value(), *lab, options.check, engine) : check(card.value(), options.check, engine);
    }
    one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    line.clear();
    if (!options.json && !is_standard_output(options.junit)) print(text_of(one));
    checked.push_back(std::move(one));
  }
  if (options.json && !is_standard_output(options.junit)) print(json_text(to_json(checked)));
  if (!options.junit.empty()) refuse(write_output(options.junit, junit_of(checked)), kFailed);
  return status_of(checked);
}

struct VerifyOptions {
  std::vector<std::string> cases;
  bool json = false;
  bool points = false;
  bool formulas = false;
};

void print_row(const std::string& name, const CheckRow& row, std::size_t points) {
  std::string at = row.point;
  if (points > 1) at += " (worst of " + std::to_string(points) + ")";
  print("%-23s %-28s %s%13.6g %14.6g %9.2e %9.0e  %-5s %s\n", name.c_str(), row.reading.c_str(), row.bound ? "<" : " ",
        row.expected, row.got, row.error, row.tolerance, std::string(name_of(row.verdict)).c_str(), at.c_str());
}

/// Prints the reason of each check that did not pass; equal ones once.
void print_notes(const std::vector<CheckRow>& rows) {
  std::set<std::string> told;
  for (const CheckRow& row : rows)
    if (!row.note.empty() && told.insert(row.note).second) print("  %s\n", row.note.c_str());
}

void print_cases(const std::vector<VerifiedCase>& cases, bool every_point) {
  print("%-23s %-28s %14s %14s %9s %9s  %-5s %s\n", "case", "reading", "expected", "got", "error", "tolerance", "",
        "at");
  for (const auto& [file, test, rows] : cases) {
    for (const CheckRow& row : every_point ? rows : worst_rows(rows))
      print_row(test.name, row, every_point ? 1 : test.points.size());
    print_notes(rows);
  }
}

int run_verify(const VerifyOptions& options) {
  if (options.formulas) {
    for (const Formula& formula : formulas())
      print("%-22s %s\n", std::string(formula.name).c_str(), std::string(formula.meaning).c_str());
    return kDone;
  }
  std::optional<WorkLine> line;
  const auto begin = [&](int points) { line.emplace("points", points); };
  const auto verified = verify_cases(options.cases, begin, [&] { line->one_done(); });
  if (line) line->clear();
  const std::vector<VerifiedCase> cases = value_or_throw(verified);
  const VerifyCounts counts = counts_of(cases);
  if (options.json) {
    print(json_text(to_json(cases)));
  } else {
    print_cases(cases, options.points);
    print("%zu cases, %zu checks, %zu failed, %zu known deviations\n", cases.size(), counts.checks, counts.failed,
          counts.known);
  }
  return counts.failed == 0 ? kDone : kFailed;
}

}  // namespace

Command add_doctor(CLI::App& verb) {
  const auto options = std::make_shared<DoctorOptions>();
  verb.add_option("PLACE", options->place, "folder of a calibration, or a card")->required();
  verb.add_flag("--json", options->json, "print the findings as JSON");
  return [options] { return run_doctor(*options); };
}

Command add_check(CLI::App& verb) {
  const auto options = std::make_shared<CheckCommand>();
  verb.add_option("CARD", options->cards, "card files")->required();
  verb.add_flag("--quick", options->check.quick, "two simulations of each test of a card");
  verb.add_flag("--bits", options->check.bits,
                "different bits are a disagreement, even if another program made the card");
  verb.add_option("--false-alarm", options->check.false_alarm,
                  "probability that an unchanged card is reported as wrong")
      ->check(number_from(1e-9, 0.5))
      ->capture_default_str();
  add_threads(verb, options->check.threads);
  auto* against = verb.add_option("--against", options->against,
                                  "compare the cards with this laboratory file instead of their own baseline")
                      ->type_name("LAB");
  auto* json = verb.add_flag("--json", options->json, "print the result as JSON");
  auto* junit = verb.add_option("--junit", options->junit, "write the result as JUnit XML; -: standard output")
                    ->type_name("FILE");
  verb.add_flag("--force", options->force, "replace FILE")->needs(junit);
  auto* rebaseline = verb.add_flag("--rebaseline", options->rebaseline,
                                   "replace the baseline of the cards by new simulations, and record the reason")
                         ->excludes(against)
                         ->excludes(json)
                         ->excludes(junit);
  verb.add_option("--why", options->why, "reason for the new baseline")->needs(rebaseline)->type_name("TEXT");
  verb.add_option("--packings", options->packings, "packings of the new baseline, if more than before")
      ->needs(rebaseline)
      ->check(whole_number(2, 1000));
  return [options] { return options->rebaseline ? rebaseline_all(*options) : check_all(*options); };
}

Command add_verify(CLI::App& verb) {
  const auto options = std::make_shared<VerifyOptions>();
  verb.add_option("CASE", options->cases, "names of shipped cases, or case files; default: all shipped cases");
  verb.add_flag("--json", options->json, "print every check at every point as JSON");
  verb.add_flag("--points", options->points, "print every point of a case, not only its worst");
  verb.add_flag("--formulas", options->formulas, "list the closed forms that a case may name");
  return [options] { return run_verify(*options); };
}

}  // namespace pastefit
