#include <cstdio>
#include <memory>

#include "calibrate/cli/commands.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/report/card_text.h"

namespace pastefit {

namespace {

int show(const std::string& file) {
  const auto card = read_card(file);
  if (!card.ok()) return report(card.faults());
  print("%s", text_of(card.value()).c_str());
  return kDone;
}

}  // namespace

Command add_show(CLI::App& verb) {
  const auto file = std::make_shared<std::string>();
  verb.add_option("CARD", *file, "card file")->required();
  return [file] { return show(*file); };
}

}  // namespace pastefit
