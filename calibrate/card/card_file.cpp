#include "calibrate/card/card_file.h"

#include <nlohmann/json.hpp>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/foreign_text.h"

namespace pastefit {

Result<std::string> readable_text(const Card& card) {
  std::string text = json_text(to_json(card));
  const auto read = card_from_json(nlohmann::json::parse(text, nullptr, false));
  if (read.ok()) return text;
  Faults faults = read.faults();
  for (Fault& fault : faults) fault.where = "the new card, " + fault.where;
  return faults;
}

Faults write_card(const std::filesystem::path& file, const Card& card) {
  const auto text = readable_text(card);
  return text.ok() ? write_atomically(file, text.value()) : text.faults();
}

}  // namespace pastefit
