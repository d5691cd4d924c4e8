#include <memory>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/report/summary.h"

namespace pastefit {

namespace {

struct ShowOptions {
  std::string card;
  bool json = false;
};

int show(const ShowOptions& options) {
  const Card card = value_or_throw(read_card(options.card));
  print("%s", (options.json ? json_text(with_yield_stresses(card)) : text_of(card)).c_str());
  return kDone;
}

}  // namespace

Command add_show(CLI::App& verb) {
  const auto options = std::make_shared<ShowOptions>();
  verb.add_option("CARD", options->card, "card file")->required();
  verb.add_flag("--json", options->json,
                "print the card as JSON, in the format of this version, with the yield stresses of its readings");
  return [options] { return show(*options); };
}

}  // namespace pastefit
