#include "calibrate/base/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "calibrate/base/text.h"

namespace pastefit {
namespace {

/// One row per spelling, as returned by `spelled`. The key's own unit is the first of a quantity; the first spelling of
/// a unit is displayed.
struct Spelling {
  std::string_view word;
  Unit unit;
};

constexpr double inch = 25.4;                 // [mm]
constexpr double pound = 0.45359237;          // [kg]
constexpr double foot = 12 * inch;            // [mm]
constexpr double pound_force = 4.4482216153;  // [N]
constexpr double cubic_foot_m3 = 1e-9 * foot * foot * foot;

constexpr std::array<Spelling, 38> spellings{{
    {"mm", {"mm", "mm", 1}},
    {"cm", {"cm", "mm", 10}},
    {"m", {"m", "mm", 1000}},
    {"in", {"in", "mm", inch}},
    {"inch", {"in", "mm", inch}},
    {"inches", {"in", "mm", inch}},
    {"\"", {"in", "mm", inch}},
    {"ft", {"ft", "mm", foot}},
    {"feet", {"ft", "mm", foot}},
    {"kg_m3", {"kg/m3", "kg_m3", 1}},
    {"kg_l", {"kg/l", "kg_m3", 1000}},
    {"kg_dm3", {"kg/l", "kg_m3", 1000}},
    {"g_cm3", {"g/cm3", "kg_m3", 1000}},
    {"t_m3", {"t/m3", "kg_m3", 1000}},
    {"lb_ft3", {"lb/ft3", "kg_m3", pound / cubic_foot_m3}},
    {"lbs_ft3", {"lb/ft3", "kg_m3", pound / cubic_foot_m3}},
    {"pcf", {"lb/ft3", "kg_m3", pound / cubic_foot_m3}},
    {"pa", {"Pa", "pa", 1}},
    {"kpa", {"kPa", "pa", 1e3}},
    {"mpa", {"MPa", "pa", 1e6}},
    {"bar", {"bar", "pa", 1e5}},
    {"psi", {"psi", "pa", pound_force / (1e-6 * inch * inch)}},
    {"kg", {"kg", "kg", 1}},
    {"g", {"g", "kg", 1e-3}},
    {"lb", {"lb", "kg", pound}},
    {"lbs", {"lb", "kg", pound}},
    {"s", {"s", "s", 1}},
    {"ms", {"ms", "s", 1e-3}},
    {"min", {"min", "s", 60}},
    {"mm_s", {"mm/s", "mm_s", 1}},
    {"cm_s", {"cm/s", "mm_s", 10}},
    {"m_s", {"m/s", "mm_s", 1000}},
    {"in_s", {"in/s", "mm_s", inch}},
    {"deg", {"degrees", "deg", 1}},
    {"rad", {"rad", "deg", degrees}},
    {"°", {"degrees", "deg", 1}},
    {"rad_s", {"rad/s", "rad_s", 1}},
    {"deg_s", {"degrees/s", "deg_s", 1}},
}};

/// Small letters, '_' for '/', no '^', and digits for superscripts.
std::string spelled(std::string_view word) {
  std::string out;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word.substr(i).starts_with("³")) {
      out += '3';
      i += std::string_view("³").size() - 1;
    } else if (word[i] == '/') {
      out += '_';
    } else if (word[i] != '^' && word[i] != ' ' && word[i] != '.') {
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(word[i])));
    }
  }
  return out;
}

}  // namespace

std::optional<Unit> unit_of_word(std::string_view word) {
  const auto found = std::ranges::find(spellings, spelled(word), &Spelling::word);
  return found == spellings.end() ? std::nullopt : std::optional(found->unit);
}

std::optional<Unit> unit_of_key(std::string_view key) {
  const Spelling* longest = nullptr;
  for (const Spelling& one : spellings) {
    const bool ends =
        key.size() > one.word.size() + 1 && key.ends_with(one.word) && key[key.size() - one.word.size() - 1] == '_';
    if (ends && (!longest || one.word.size() > longest->word.size())) longest = &one;
  }
  return longest ? std::optional(longest->unit) : std::nullopt;
}

std::optional<Unit> unit_of_place(std::string_view place) {
  static constexpr std::array<std::string_view, 4> of_parent{"value", "standard_deviation", "repeats", "free"};
  std::string_view step;
  do {
    const auto dot = place.rfind('.');
    step = dot == std::string_view::npos ? place : place.substr(dot + 1);
    step = step.substr(0, step.find('['));
    place = dot == std::string_view::npos ? std::string_view() : place.substr(0, dot);
  } while (!place.empty() && std::ranges::count(of_parent, step) > 0);
  const bool weight = place.starts_with("weights") || place.find(".weights") != std::string_view::npos;
  const std::optional<Unit> unit = weight ? std::nullopt : unit_of_key(step);
  return unit && unit->factor == 1 ? unit : std::nullopt;  // SI keys are those of cards, which are not typed
}

std::string in_other_units(double number, std::string_view key_unit, double smallest, double largest) {
  std::string out;
  std::string_view last;
  for (const auto& [word, unit] : spellings) {
    if (unit.key != key_unit || unit.factor == 1 || unit.name == last) continue;
    last = unit.name;
    const double value = number * unit.factor;
    if (number == 0 || !(value >= smallest && value <= largest)) continue;
    out += (out.empty() ? "" : ", ") + shown(number) + " " + std::string(unit.name) + " are " + shown(value) + " " +
           std::string(unit_of_word(key_unit)->name);
  }
  return out;
}

std::optional<WrittenNumber> written_number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  const std::size_t end = std::min(text.find_first_not_of("+-0123456789.,eE"), text.size());
  std::string number(text.substr(0, end));
  std::string_view word = text.substr(end);
  WrittenNumber out;
  if (const auto comma = number.find(','); comma != std::string::npos) {
    out.comma = true;
    number[comma] = '.';
  }
  const auto value = parsed_number<double>(number);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  out.value = *value;
  if (word.empty()) return out;
  out.unit = unit_of_word(word);
  return out.unit ? std::optional(out) : std::nullopt;
}

}  // namespace pastefit
