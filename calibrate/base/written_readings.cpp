#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {
namespace {

/// Converts "7 1/4", "7-1/4" and "7¼" to 7.25, and "1/4" in inches to 0.25; "18/19 cm" are two readings.
std::string with_decimals(std::string text) {
  static const std::regex fraction(R"((?:(\d{1,6})[ -])?\b(\d{1,2})/(\d{1,2})\b)");
  static const std::array<std::pair<std::regex, const char*>, 3> signs{
      {{std::regex(" ?¼"), " 1/4"}, {std::regex(" ?½"), " 1/2"}, {std::regex(" ?¾"), " 3/4"}}};
  for (const auto& [sign, written] : signs) text = std::regex_replace(text, sign, written);
  const std::size_t last = text.find_last_of("0123456789");
  const auto unit = last == std::string::npos ? std::nullopt : unit_of_word(text.substr(last + 1));
  std::string out;
  auto from = text.cbegin();
  for (std::sregex_iterator found(text.cbegin(), text.cend(), fraction), end; found != end; ++found) {
    const std::smatch& match = *found;
    const double numerator = std::stod(match[2]), denominator = std::stod(match[3]);
    const bool whole = match[1].matched, inches = unit && unit->name == "in";
    if (numerator >= denominator || (!whole && !inches)) continue;
    out.append(from, match[0].first);
    out += shown((whole ? std::stod(match[1]) : 0) + numerator / denominator);
    from = match[0].second;
  }
  return out.append(from, text.cend());
}

/// Suggested replacement for a text that is not a number, if its meaning is known; otherwise empty.
std::string_view meant_by(const std::string& text) {
  constexpr std::size_t longest = 100;  // std::regex recurses with the length
  static const std::array<std::pair<std::regex, std::string_view>, 6> meanings{{
      {std::regex(R"([<>]|≥|≤|\+ *$|\b(at (least|most)|(more|less) than|over|under|above|below|min|max)\b)"),
       "a number: of a limit it is only known that the reading lies beyond it"},
      {std::regex(R"(\+/?-|±|~|≈|\b(about|around|approx|ca|circa)\b)"),
       "the value alone; its deviation is --sd of pastefit new, \"standard_deviation\" of the reading in lab.json"},
      {std::regex("%"), "a number with its unit; a flow in per cent is --flow \"110 %\""},
      {std::regex(R"(\d\D*(-|–|\bto\b|\band\b)\D*\d)"), "both ends of the range as two readings: \"180, 190\""},
      {std::regex(R"(\d\D*([x*/]|×|\bby\b)\D*\d)"),
       "the mean of both widths, or both as \"500, 510\"; a fraction is one of inches: \"7 1/4 in\""},
      {std::regex(","), "a space after each comma between numbers: \"180, 175, 190\""},
  }};
  const std::string start = small_letters(text.substr(0, longest));
  for (const auto& [written, meant] : meanings)
    if (std::regex_search(start, written)) return meant;
  return "";
}

/// Splits a text at semicolons, at commas before a space, and at spaces before a digit.
std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  std::size_t start = 0;
  while (start < text.size()) {
    std::size_t end = start;
    for (; end < text.size(); ++end) {
      const char next = end + 1 < text.size() ? text[end + 1] : ' ';
      const bool digit = (next >= '0' && next <= '9') || next == '-' || next == '.';
      if (text[end] == ';' || (text[end] == ',' && next == ' ') || (text[end] == ' ' && digit && end > start)) break;
    }
    const std::string_view part = text.substr(start, end - start);
    start = end + 1;
    if (part.find_first_not_of(' ') != std::string_view::npos) parts.push_back(part);
  }
  return parts;
}

}  // namespace

std::string with_percent_sign(const std::string& text) {
  static const std::regex word("per ?cent", std::regex::icase);
  return std::regex_replace(text, word, "%");
}

Result<std::vector<double>> written_readings(const std::string& where, const std::string& text,
                                             std::string_view unit_key) {
  constexpr std::size_t longest = 10'000;  // std::regex recurses with the length
  if (text.size() > longest)
    return Fault{where, "has " + std::to_string(text.size()) + " letters", "some numbers: \"180, 175, 190\""};
  const auto unit_now = unit_of_word(unit_key);
  const std::string own = unit_now ? " in " + std::string(unit_now->name) : "";
  const auto wrong = [&](std::string what) {
    return Fault{where, std::move(what), "numbers" + own + " or with their unit, e.g. \"180, 175, 190\""};
  };
  const std::string decimal = with_decimals(text);
  std::vector<WrittenNumber> numbers;
  for (const std::string_view part : parts_of(decimal)) {
    const auto number = written_number(part);
    if (!number) {
      const std::string meant(meant_by(with_percent_sign(decimal)));
      if (!meant.empty()) return Fault{where, "holds " + in_quotes(text) + ", which is not a number", meant};
      return wrong("holds " + in_quotes(part) + ", which is not a number");
    }
    if (number->comma)
      return Fault{where, "holds " + in_quotes(part),
                   "a decimal point, or a space after the comma between two numbers"};
    numbers.push_back(*number);
  }
  if (numbers.empty()) return wrong("is empty");
  const std::optional<Unit> last = numbers.back().unit;
  const auto is_bare = [](const WrittenNumber& number) { return !number.unit; };
  const auto is_other = [&](const WrittenNumber& number) {
    return number.unit && number.unit->factor != (last ? last->factor : 1);
  };
  if (std::ranges::any_of(numbers, is_bare) && std::ranges::any_of(numbers, is_other))
    return Fault{where, "holds " + in_quotes(text) + ", with a unit for some numbers",
                 "one unit at the end, or one for each number"};
  std::vector<double> out;
  for (const WrittenNumber& number : numbers) {
    const std::optional<Unit> unit = number.unit ? number.unit : last;
    if (unit && unit->key != unit_key) return wrong("is in " + std::string(unit->name));
    out.push_back(rounded(number.value * (unit ? unit->factor : 1), 6));
  }
  return out;
}

}  // namespace pastefit
