#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/report/summary.h"

namespace pastefit {

namespace {

using Values = std::vector<std::optional<double>>;  // of each card; may be missing

struct ComparedParameter {
  std::string name;
  Values values;
  std::vector<bool> excluded;  // by another card's interval
};

struct ComparedReading {
  std::string name;
  Values simulated, measured;
};

/// Range of the existing values.
std::pair<double, double> range_of(const Values& values) {
  std::pair out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& value : values)
    if (value) out = {std::min(out.first, *value), std::max(out.second, *value)};
  return out;
}

const Parameter* parameter_of(const Card& card, std::string_view name) {
  const auto found = std::ranges::find(card.material.parameters, name, &Parameter::name);
  return found != card.material.parameters.end() && has_parameter(card, name) ? &*found : nullptr;
}

bool excludes(const Card& card, std::string_view parameter, double value) {
  const auto& intervals = card.inference.intervals;
  const auto found = std::ranges::find(intervals, parameter, &CardInference::Interval::parameter);
  return found != intervals.end() && (value < found->lower || value > found->upper);
}

ComparedParameter compared_parameter(std::span<const CardFile> cards, const std::string& name) {
  ComparedParameter out{name, {}, {}};
  for (const CardFile& one : cards) {
    const Parameter* parameter = parameter_of(one.card, name);
    out.values.push_back(parameter ? std::optional(parameter->value) : std::nullopt);
    out.excluded.push_back(parameter && std::ranges::any_of(cards, [&](const CardFile& other) {
                             return excludes(other.card, name, parameter->value);
                           }));
  }
  return out;
}

std::vector<ComparedParameter> compared_parameters(std::span<const CardFile> cards) {
  std::vector<ComparedParameter> out;
  for (const Parameter& parameter : cards.front().card.material.parameters) {
    ComparedParameter one = compared_parameter(cards, parameter.name);
    const auto [least, largest] = range_of(one.values);
    const bool in_all = std::ranges::all_of(one.values, [](const auto& value) { return value.has_value(); });
    if (least < largest || (least == largest && !in_all)) out.push_back(std::move(one));
  }
  return out;
}

const CardReading* reading_of(const Card& card, std::string_view name) {
  for (const CardTest& test : card.tests)
    for (const CardReading& reading : test.readings)
      if (reading_name(test, reading.name) == name) return &reading;
  return nullptr;
}

/// Readings measured for any card, in the order of the cards.
std::vector<ComparedReading> compared_readings(std::span<const CardFile> cards) {
  std::vector<ComparedReading> out;
  for (const CardFile& one : cards)
    for (const CardTest& test : one.card.tests)
      for (const CardReading& reading : test.readings) {
        const std::string name = reading_name(test, reading.name);
        if (reading.measured && std::ranges::find(out, name, &ComparedReading::name) == out.end())
          out.push_back({name, {}, {}});
      }
  for (ComparedReading& row : out)
    for (const CardFile& one : cards) {
      const CardReading* reading = reading_of(one.card, row.name);
      row.simulated.push_back(reading ? std::optional(reading->simulated.mean) : std::nullopt);
      row.measured.push_back(reading ? reading->measured : std::nullopt);
    }
  return out;
}

/// Letter of a card in a table: "A", "B", ..., "Z", "A1", ...
std::string letter_of(std::size_t card) {
  constexpr std::size_t letters = 26;
  const std::string letter(1, static_cast<char>('A' + card % letters));
  return card < letters ? letter : letter + std::to_string(card / letters);
}

/// Table row: the cells of cards `first` to `last`, then text on all of them.
std::string table_row(const std::string& name, const Values& values, std::size_t first, std::size_t last,
                      const std::vector<bool>& marked, const std::string& behind) {
  constexpr std::size_t widest = 25;
  std::string out =
      "  " + name +
      (name.size() > widest ? "\n" + std::string(widest + 2, ' ') : std::string(widest - name.size(), ' '));
  for (std::size_t i = first; i < last; ++i)
    out += format("%10s", values[i] ? plain(*values[i], 4) : "-") + (i < marked.size() && marked[i] ? "*" : " ");
  out += format("%9s", behind);
  out.erase(out.find_last_not_of(' ') + 1);
  return out + "\n";
}

std::string heading(const std::string& name, std::size_t first, std::size_t last, const std::string& behind) {
  std::string out = format("%-27s", name);
  for (std::size_t i = first; i < last; ++i) out += format("%10s ", letter_of(i));
  return out + format("%9s\n", behind);
}

std::string tables(std::span<const ComparedParameter> parameters, std::span<const ComparedReading> readings,
                   std::size_t first, std::size_t last) {
  std::string out;
  if (!parameters.empty()) out += "\n" + heading("Parameters that differ", first, last, "ratio");
  for (const ComparedParameter& one : parameters) {
    const auto [least, largest] = range_of(one.values);
    out += table_row(one.name, one.values, first, last, one.excluded, least > 0 ? plain(largest / least, 3) : "");
  }
  if (!readings.empty()) out += "\n" + heading("Readings, simulated", first, last, "apart");
  for (const ComparedReading& one : readings) {
    const auto [least, largest] = range_of(one.simulated);
    out += table_row(one.name, one.simulated, first, last, {}, plain(largest - least, 3));
    out += table_row("  measured", one.measured, first, last, {}, "");
  }
  return out;
}

nlohmann::ordered_json numbers_or_null(const Values& values) {
  auto out = nlohmann::ordered_json::array();
  for (const auto& value : values) out.push_back(value ? nlohmann::ordered_json(*value) : nullptr);
  return out;
}

}  // namespace

std::string comparison_lines(std::span<const CardFile> cards) {
  constexpr std::size_t columns = 4;
  std::string out = "Cards\n";
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const std::string unconfirmed = unconfirmed_line(cards[i].card);
    out += format("  %-3s", letter_of(i)) + one_line(printable(cards[i].name)) + ": " +
           (unconfirmed.empty() ? format("confirmed, error %.2f of the tolerance", cards[i].card.confirmation.error)
                                : unconfirmed) +
           "\n";
  }
  const auto parameters = compared_parameters(cards);
  const auto readings = compared_readings(cards);
  for (std::size_t first = 0; first < cards.size(); first += columns)
    out += tables(parameters, readings, first, std::min(first + columns, cards.size()));
  const auto marked = [](const ComparedParameter& one) {
    return std::ranges::find(one.excluded, true) != one.excluded.end();
  };
  if (std::ranges::any_of(parameters, marked))
    return out + "\n* outside the interval of another card: the two cards disagree.\n";
  return out + "\nNo card has a value outside the interval of another card.\n";
}

nlohmann::ordered_json comparison_json(std::span<const CardFile> cards) {
  nlohmann::ordered_json out{{"cards", nlohmann::ordered_json::array()},
                             {"parameters", nlohmann::ordered_json::object()},
                             {"readings", nlohmann::ordered_json::object()}};
  for (const CardFile& one : cards)
    out["cards"].push_back({{"file", one.name},
                            {"title", one.card.title},
                            {"confirmed", cause_unconfirmed(one.card).empty()},
                            {"error", one.card.confirmation.error},
                            {"seed", one.card.search.seed}});
  for (const ComparedParameter& one : compared_parameters(cards))
    out["parameters"][one.name] = {{"values", numbers_or_null(one.values)}, {"excluded", one.excluded}};
  for (const ComparedReading& one : compared_readings(cards))
    out["readings"][one.name] = {{"simulated", numbers_or_null(one.simulated)},
                                 {"measured", numbers_or_null(one.measured)}};
  return out;
}

}  // namespace pastefit
