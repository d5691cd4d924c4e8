#include "calibrate/card/card_versions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "calibrate/card/card.h"
#include "calibrate/study/json_document.h"

namespace pastefit {

namespace {

using nlohmann::json;

constexpr std::string_view kPrefix = "pastefit-card-";

std::string format_of(int version) {
  return std::string(kPrefix) + std::to_string(version);
}

void from_1(json& card) {
  card["baseline"] = {{"program", ""}, {"machine", ""}, {"packings", json::array()}, {"readings", json::object()}};
}

/// The n-th step leads from version n + 1 to the next one.
constexpr std::array<void (*)(json&), kCardVersion - 1> kSteps{from_1};

/// The number after the prefix; 0 if it is none.
int version_of(const std::string& format) {
  int version = 0;
  const char* const end = format.data() + format.size();
  const auto [rest, error] = std::from_chars(format.data() + kPrefix.size(), end, version);
  return error == std::errc() && rest == end ? std::max(version, 0) : 0;
}

}  // namespace

bool is_card(const json& document) {
  const auto format = document.is_object() ? document.value("format", json()) : json();
  return format.is_string() && format.get_ref<const std::string&>().starts_with(kPrefix);
}

Result<json> upgraded_card(json document) {
  Faults faults;
  if (!is_card(document)) {
    has_format(document, format_of(kCardVersion), faults);
    return faults;
  }
  const auto format = document["format"].get<std::string>();
  const int version = version_of(format);
  if (version < 1 || version > kCardVersion)
    return Fault{"format",
                 "is \"" + format + "\", but this program knows cards up to version " + std::to_string(kCardVersion),
                 "use the version of pastefit that wrote the card, or a newer one"};
  for (int step = version; step < kCardVersion; ++step) kSteps[static_cast<std::size_t>(step - 1)](document);
  document["format"] = format_of(kCardVersion);
  return document;
}

}  // namespace pastefit
