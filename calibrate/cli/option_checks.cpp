#include "calibrate/cli/option_checks.h"

#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "calibrate/base/text.h"

namespace pastefit {

namespace {

/// The number that the text is, as a whole.
template <class Number>
std::optional<Number> number_of(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return number;
}

template <class Number, class Holds>
CLI::Validator check_that(std::string right, Holds holds) {
  return CLI::Validator(
      [right = std::move(right), holds](std::string& text) -> std::string {
        const auto number = number_of<Number>(text);
        return number && holds(*number) ? "" : "is " + in_quotes(text) + "; give " + right;
      },
      "");
}

}  // namespace

CLI::Validator positive_number() {
  return check_that<double>("a number above 0, at most 1e9", [](double number) { return number > 0 && number <= 1e9; });
}

CLI::Validator number_from(double smallest, double largest) {
  return check_that<double>("a number from " + shown(smallest) + " to " + shown(largest),
                            [=](double number) { return number >= smallest && number <= largest; });
}

CLI::Validator whole_number(std::uint64_t smallest, std::uint64_t largest) {
  return check_that<std::uint64_t>("a whole number from " + std::to_string(smallest) + " to " + std::to_string(largest),
                                   [=](std::uint64_t number) { return number >= smallest && number <= largest; });
}

}  // namespace pastefit
