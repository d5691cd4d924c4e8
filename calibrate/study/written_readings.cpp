#include "calibrate/study/written_readings.h"

#include <algorithm>
#include <optional>
#include <regex>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {
namespace {

/// "7 1/4" as 7.25.
std::string with_decimals(const std::string& text) {
  static const std::regex mixed(R"((\d{1,6}) (\d{1,6})/(\d{1,6}))");
  std::string out;
  auto from = text.cbegin();
  for (std::sregex_iterator found(text.begin(), text.end(), mixed), end; found != end; ++found) {
    const std::smatch& match = *found;
    const double divisor = std::stod(match[3]);
    if (divisor == 0) continue;
    out.append(from, match[0].first);
    out += shown(std::stod(match[1]) + std::stod(match[2]) / divisor);
    from = match[0].second;
  }
  return out.append(from, text.cend());
}

/// What to write in the place of a text that is no number, where it is known what was meant.
std::string meant_by(std::string_view text) {
  const auto holds = [&](std::string_view part) { return text.find(part) != std::string_view::npos; };
  if (holds(">") || holds("<")) return "a number: of a limit it is only known that the reading lies beyond it";
  if (holds("+-") || holds("+/-") || holds("±"))
    return R"(the value alone; its deviation is "standard_deviation" of the reading in lab.json)";
  if (holds("x") || holds("×")) return "the mean of both widths, or both as \"500, 510\"";
  if (std::ranges::count(text, ',') > 0) return "a space after each comma between numbers: \"180, 175, 190\"";
  return "";
}

/// The texts of the numbers: one ends at a semicolon, at a comma before a space, or at a space before a digit.
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

Result<std::vector<double>> written_readings(const std::string& where, const std::string& text,
                                             std::string_view unit_key) {
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
      const std::string meant = meant_by(text);
      if (!meant.empty()) return Fault{where, "holds " + in_quotes(text) + ", which is no number", meant};
      return wrong("holds " + in_quotes(part) + ", which is no number");
    }
    if (number->comma)
      return Fault{where, "holds " + in_quotes(part),
                   "a decimal point, or a space after the comma between two numbers"};
    numbers.push_back(*number);
  }
  if (numbers.empty()) return wrong("is empty");
  const std::optional<Unit> last = numbers.back().unit;
  std::vector<double> out;
  for (const WrittenNumber& number : numbers) {
    const std::optional<Unit> unit = number.unit ? number.unit : last;
    if (unit && unit->key != unit_key) return wrong("is in " + std::string(unit->name));
    out.push_back(rounded(number.value * (unit ? unit->factor : 1), 6));
  }
  return out;
}

}  // namespace pastefit
