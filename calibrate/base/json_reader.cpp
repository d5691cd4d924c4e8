#include "calibrate/base/json_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "calibrate/base/units.h"

namespace pastefit {
namespace {

using nlohmann::json;

constexpr double largest_whole = 9007199254740992;  // 2^53: whole numbers are exact in a double up to here

/// Advice for a key that is known in another unit; may be empty.
std::string in_unit_of_files(std::string_view key, const Names& known) {
  const std::optional<Unit> unit = unit_of_key(key);
  if (!unit) return "";
  Names of_quantity;
  for (const std::string& word : known) {
    const std::optional<Unit> own = unit_of_key(word);
    if (own && own->key == unit->key && own->factor == 1) of_quantity.insert(word);
  }
  const std::size_t cut = key.find_last_of('_', key.size() - 2);
  std::optional<std::string> near = nearest(std::string(key.substr(0, cut + 1)) + std::string(unit->key), of_quantity);
  if (!near && of_quantity.size() == 1) near = *of_quantity.begin();
  if (!near || unit->factor == 1) return "";
  const std::string own(unit_of_word(unit->key)->name);
  return "give " + in_quotes(*near) + " in " + own + ": 1 " + std::string(unit->name) + " is " + shown(unit->factor) +
         " " + own;
}

/// Advice for a text that contains a number, with a decimal comma or a unit; may be empty.
std::string as_number(const json& value, const std::optional<Unit>& unit) {
  const std::string* text = value.get_ptr<const std::string*>();
  const std::optional<WrittenNumber> written = text ? written_number(*text) : std::nullopt;
  if (!written || (written->unit && (!unit || written->unit->key != unit->key))) return "";
  const double factor = written->unit ? written->unit->factor : 1;
  return "write " + shown(written->value * factor) + (written->comma ? ", with a decimal point and" : ",") +
         " without quotes";
}

/// List with numbers split by decimal commas joined again: [162,5, 165,0] becomes 162.5 and 165.0.
std::string without_decimal_commas(const json& list, std::size_t wanted) {
  const bool whole = std::ranges::all_of(list, [](const json& entry) { return entry.is_number_integer(); });
  if (!whole || list.empty() || list.size() % 2 != 0 || (wanted > 0 && list.size() != 2 * wanted)) return "";
  constexpr double most_digits = 99;
  double smallest = std::numeric_limits<double>::max(), largest = 0, fraction = 0;
  std::string out;
  for (std::size_t i = 0; i < list.size(); i += 2) {
    const double before = list[i].get<double>(), after = list[i + 1].get<double>();
    if (before < 0 || after < 0 || after > most_digits) return "";
    smallest = std::min(smallest, before);
    largest = std::max(largest, before);
    fraction = std::max(fraction, after);
    out += (out.empty() ? "[" : ", ") + list[i].dump() + "." + list[i + 1].dump();
  }
  // Without a known number of entries, alternating large and small numbers are the evidence.
  const bool by_turns = fraction < smallest / 2 && largest - smallest < (smallest - fraction) / 2;
  return wanted > 0 || by_turns ? out + "]" : "";
}

}  // namespace

std::string text_of(const Range& range, std::string_view unit) {
  const bool below = range.smallest > std::numeric_limits<double>::lowest();
  const bool above = range.largest < std::numeric_limits<double>::max();
  const std::string end = unit.empty() ? "" : " " + std::string(unit);
  if (!below && !above) return "must be a number";
  if (!below) return "must be at most " + shown(range.largest) + end;
  if (!above) return (range.open ? "must be above " : "must be at least ") + shown(range.smallest) + end;
  if (range.open) return "must be above " + shown(range.smallest) + " and at most " + shown(range.largest) + end;
  return "must be " + shown(range.smallest) + " to " + shown(range.largest) + end;
}

ObjectReader::~ObjectReader() {
  for (const auto& [key, value] : object_.items()) {
    if (known_.contains(key)) continue;
    std::string remedy = in_unit_of_files(key, known_);
    if (remedy.empty()) remedy = did_you_mean(key, known_, "known here: " + listed(known_, in_quotes));
    faults_.push_back({joined(place_, printable(key)), std::string(unknown_key), std::move(remedy)});
  }
}

std::vector<std::string> ObjectReader::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object_.items()) keys.push_back(key);
  return keys;
}

const json* ObjectReader::content(std::string_view key) const {
  const auto value = object_.find(key);
  return value == object_.end() ? nullptr : &*value;
}

void ObjectReader::fault(std::string_view key, std::string what, std::string remedy) {
  faults_.push_back({place(key), std::move(what), std::move(remedy)});
}

bool ObjectReader::number(const Key& key, double& target, const Range& range, Need need, double per_si) {
  const json* value = find(key, need);
  if (!value || !check_number(place(key), *value, range.judged_later ? Range{} : range)) return false;
  target = value->get<double>() / per_si;
  return true;
}

bool ObjectReader::nullable_number(const Key& key, std::optional<double>& target, const Range& range, Need need) {
  const json* value = find(key, need);
  if (!value) return false;
  if (!value->is_null() && !check_number(place(key), *value, range.judged_later ? Range{} : range)) return false;
  target.reset();
  if (!value->is_null()) target = value->get<double>();
  return true;
}

bool ObjectReader::integer(const Key& key, int& target, int smallest, int largest, Need need) {
  const json* value = find(key, need);
  if (!value) return false;
  const double number = value->is_number() ? value->get<double>() : 0.5;
  if (number != std::floor(number) || number < smallest || number > largest) {
    fault(key, "is " + text_of(*value),
          "must be a whole number, " + std::to_string(smallest) + " to " + std::to_string(largest));
    return false;
  }
  target = static_cast<int>(number);
  return true;
}

bool ObjectReader::integer(const Key& key, std::uint64_t& target, Need need) {
  const json* value = find(key, need);
  if (!value) return false;
  if (value->is_number_unsigned()) {
    target = value->get<std::uint64_t>();
    return true;
  }
  const double number = value->is_number_float() ? value->get<double>() : -1;
  if (number < 0 || number != std::floor(number) || number > largest_whole) {
    fault(key, "is " + text_of(*value), "a whole number of at least 0");
    return false;
  }
  target = static_cast<std::uint64_t>(number);
  return true;
}

template <class T>
bool ObjectReader::value_of_kind(const Key& key, T& target, Need need, bool (json::*is_kind)() const noexcept,
                                 const char* remedy) {
  const json* value = find(key, need);
  if (!value) return false;
  if (!(value->*is_kind)()) {
    fault(key, "is " + text_of(*value), remedy);
    return false;
  }
  target = value->get<T>();
  return true;
}

bool ObjectReader::text(const Key& key, std::string& target, Need need) {
  return value_of_kind(key, target, need, &json::is_string, "a text in quotes");
}

bool ObjectReader::flag(const Key& key, bool& target, Need need) {
  return value_of_kind(key, target, need, &json::is_boolean, "true or false");
}

bool ObjectReader::numbers(const Key& key, std::vector<double>& target, const Range& range, Need need,
                           std::size_t least, std::size_t most) {
  const json* value = find(key, need);
  if (!value) return false;
  const bool any_length = most == 0;
  if (!value->is_array() || value->size() < least || (!any_length && value->size() > most)) {
    const std::string count = std::to_string(least);
    const std::string decimals = value->is_array() ? without_decimal_commas(*value, most) : "";
    fault(key, "is " + (value->is_array() ? "a list of " + std::to_string(value->size()) : text_of(*value)),
          (most == least ? "a list of " + count + " numbers" : "a list of at least " + count + " numbers") +
              (decimals.empty() ? "" : "; with decimal points it is " + decimals));
    return false;
  }
  if (const std::string decimals = any_length ? without_decimal_commas(*value, 0) : ""; !decimals.empty()) {
    fault(key, "is a list of " + std::to_string(value->size()) + " whole numbers, large and small by turns",
          "a decimal comma parts two numbers here: write " + decimals);
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < value->size(); ++i)
    good = check_number(place(key) + "[" + std::to_string(i) + "]", (*value)[i], range) && good;
  if (good) target = value->get<std::vector<double>>();
  return good;
}

bool ObjectReader::pairs(const Key& key, std::vector<std::array<double, 2>>& target, const Range& first,
                         const Range& second, Need need, std::size_t least) {
  const json* value = find(key, need);
  if (!value) return false;
  if (!value->is_array() || value->size() < least) {
    fault(key, "is " + (value->is_array() ? "a list of " + std::to_string(value->size()) : text_of(*value)),
          "a list of at least " + std::to_string(least) + " pairs of numbers");
    return false;
  }
  bool good = true;
  std::vector<std::array<double, 2>> read;
  for (std::size_t i = 0; i < value->size(); ++i) {
    const std::string entry = "[" + std::to_string(i) + "]";
    const json& pair = (*value)[i];
    if (!pair.is_array() || pair.size() != 2) {
      fault(std::string(key) + entry, "is " + text_of(pair), "a pair of numbers");
      good = false;
      continue;
    }
    const bool one = check_number(place(key) + entry + "[0]", pair[0], first);
    const bool other = check_number(place(key) + entry + "[1]", pair[1], second);
    const bool both = one && other;  // reports the faults of both
    good = good && both;
    if (!both) continue;
    read.push_back(pair.get<std::array<double, 2>>());
    if (read.size() < 2 || read[read.size() - 2][0] < read.back()[0]) continue;
    fault(std::string(key) + entry, "does not lie beyond the one before it",
          "points in the order of their first number");
    good = false;
  }
  if (good) target = std::move(read);
  return good;
}

template <class T>
bool ObjectReader::list_of_kind(const Key& key, std::vector<T>& target, Need need,
                                bool (json::*is_kind)() const noexcept, const char* remedy) {
  const json* value = find(key, need);
  if (!value) return false;
  if (!value->is_array() || !std::ranges::all_of(*value, [&](const json& entry) { return (entry.*is_kind)(); })) {
    fault(key, "is " + (value->is_array() ? "a list with other entries" : text_of(*value)), remedy);
    return false;
  }
  target = value->get<std::vector<T>>();
  return true;
}

bool ObjectReader::integers(const Key& key, std::vector<std::uint64_t>& target, Need need) {
  return list_of_kind(key, target, need, &json::is_number_unsigned, "a list of whole numbers of at least 0");
}

bool ObjectReader::texts(const Key& key, std::vector<std::string>& target, Need need) {
  return list_of_kind(key, target, need, &json::is_string, "a list of texts in quotes");
}

bool ObjectReader::optional_number(const Key& key, std::optional<double>& target, const Range& range) {
  double value = 0;
  const bool there = number(key, value, range, Need::optional);
  if (there) target = value;
  return there;
}

void ObjectReader::for_each_object(const Key& key, Need need, const std::function<void(ObjectReader&)>& body) {
  known_.emplace(key);
  const json* list = content(key);
  if (need == Need::required && (!list || (list->is_array() && list->empty())))
    return fault(key, "there are none", "at least one: [ { ... } ]");
  if (!list) return;
  if (!list->is_array()) return fault(key, "is not a list", "a list of objects [ { ... } ]");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string entry = std::string(key) + "[" + std::to_string(i) + "]";
    if (!(*list)[i].is_object()) {
      fault(entry, "is not an object", "an object { ... }");
      continue;
    }
    ObjectReader reader((*list)[i], place(entry), faults_);
    body(reader);
  }
}

void ObjectReader::refuse(std::string_view key, std::string what, std::string remedy) {
  if (!has(key)) return;
  known_.emplace(key);
  fault(key, std::move(what), std::move(remedy));
}

const json* ObjectReader::find(std::string_view key, Need need) {
  known_.emplace(key);
  const json* value = content(key);
  if (!value && need == Need::required) fault(key, "is missing", "add it");
  return value;
}

std::string ObjectReader::remedy_of(const json& value, const Names& keys) {
  if (keys.empty()) return "an object { ... }";
  if (keys.size() == 1 && value.is_number()) return "write {" + in_quotes(*keys.begin()) + ": " + value.dump() + "}";
  return "an object { ... } with " + listed(keys, in_quotes);
}

bool ObjectReader::check_number(std::string_view place, const json& value, const Range& range) {
  bool good = value.is_number();
  if (good) {
    const double number = value.get<double>();
    good = number >= range.smallest && number <= range.largest && !(range.open && number == range.smallest);
  }
  if (good) return true;
  const std::optional<Unit> unit = unit_of_place(place);
  std::string remedy = as_number(value, unit);
  if (remedy.empty()) remedy = text_of(range, unit ? unit->name : "");
  if (value.is_number() && unit)
    if (const std::string meant = in_other_units(value.get<double>(), unit->key, range.smallest, range.largest);
        !meant.empty())
      remedy += "; " + meant;
  const std::string in_unit = value.is_number() && unit ? " " + std::string(unit->name) : "";
  faults_.push_back({std::string(place), "is " + text_of(value) + in_unit, std::move(remedy)});
  return false;
}

std::optional<std::size_t> ObjectReader::word(std::string_view key, std::span<const std::string_view> words,
                                              Need need) {
  const json* value = find(key, need);
  if (!value) return std::nullopt;
  const std::string* text = value->get_ptr<const std::string*>();
  const auto found = text ? std::find(words.begin(), words.end(), *text) : words.end();
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const Names names(words.begin(), words.end());
  const std::optional<std::string> near = text ? nearest(*text, names) : std::nullopt;
  fault(key, "is " + text_of(*value),
        (near ? "did you mean " + in_quotes(*near) + "? Known: " : "one of ") + listed(names, in_quotes));
  return std::nullopt;
}

}  // namespace pastefit
