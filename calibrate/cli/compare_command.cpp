#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/base/refusal.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/comparison.h"

namespace pastefit {

namespace {

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

}  // namespace

Command add_compare(CLI::App& verb) {
  const auto options = std::make_shared<CompareArguments>();
  constexpr int least = 2, most = 1000;
  verb.add_option("CARD", options->files, "card files, at least two")->required()->expected(least, most);
  verb.add_flag("--json", options->json, "print the numbers as JSON");
  return [options] { return run_compare(*options); };
}

}  // namespace pastefit
