#include "calibrate/card/card_format.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "calibrate/base/json_document.h"
#include "calibrate/card/card.h"

namespace pastefit {

namespace {

using nlohmann::json;

constexpr std::string_view kPrefix = "pastefit-card-";

}  // namespace

bool is_card(const json& document) {
  const auto format = document.is_object() ? document.value("format", json()) : json();
  return format.is_string() && format.get_ref<const std::string&>().starts_with(kPrefix);
}

Faults card_format_faults(const json& document) {
  const std::string known = std::string(kPrefix) + std::to_string(kCardVersion);
  Faults faults;
  if (!is_card(document))
    has_format(document, known, faults);
  else if (const auto format = document["format"].get<std::string>(); format != known)
    faults.push_back({"format", "is \"" + format + "\"; this program reads \"" + known + "\"",
                      "use the version of pastefit that wrote the card, or a newer one"});
  return faults;
}

}  // namespace pastefit
