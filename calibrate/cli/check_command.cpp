#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/check/check.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

namespace {

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
    auto card = read_card(file);
    append(faults, card);
    if (!card.ok()) continue;
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
    if (!options.json && !is_standard_output(options.junit)) print("%s", text_of(one).c_str());
    checked.push_back(std::move(one));
  }
  if (options.json && !is_standard_output(options.junit)) print("%s", json_text(to_json(checked)).c_str());
  if (!options.junit.empty()) refuse(write_output(options.junit, junit_of(checked)), kFailed);
  return status_of(checked);
}

}  // namespace

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

}  // namespace pastefit
