#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/base/field.h"
#include "calibrate/base/text.h"
#include "core/result.h"

namespace pastefit {

/// Parses JSON text with `//` and `/* */` comments. Appends to `faults`: invalid JSON (with line and column), and
/// duplicate keys in an object (with its place). Nothing only if the text is invalid; with duplicate keys the document
/// is still returned, to find its other faults. More than 32 nesting levels are invalid.
std::optional<nlohmann::json> parse_json(std::string_view text, Faults& faults);

/// Parses a file of at most 16 MB with `parse_json`; an unreadable file is a fault.
std::optional<nlohmann::json> read_json(const std::filesystem::path& file, Faults& faults);

/// Applies `from_json`, which returns a `Result`, to a file's content; its faults begin with the file name.
auto read_file(const std::filesystem::path& file, const auto& from_json)
    -> decltype(from_json(std::declval<nlohmann::json&>())) {
  Faults faults;
  auto document = read_json(file, faults);
  if (!document) return faults;
  auto read = from_json(*document);
  if (read.ok() && faults.empty()) return read;
  if (!read.ok()) append(faults, in_file(read.faults(), file));
  return faults;
}

/// Checks the document's "format", e.g. "pastefit-lab-1". False only if reading on is pointless: it is not an object,
/// or another kind of pastefit file.
bool has_format(const nlohmann::json& document, std::string_view expected, Faults& faults);

/// The value in faults: numbers and texts verbatim, "an object", "a list" or "null".
std::string text_of(const nlohmann::json& value);

class ObjectSchema;

/// "must be 1 to 5000 mm", for remedies.
std::string text_of(const Range& range, std::string_view unit = "");

/// Strict reader of a JSON object. Variables keep their value if a key is absent or invalid. Each call describes one
/// key completely, and is its only description. The destructor reports every key without a call. All readers return
/// whether the variable was set.
class ObjectReader {
 public:
  static constexpr bool reads = true;
  /// `value` must outlive the reader. `place`: path of the object, empty for the document.
  ObjectReader(const nlohmann::json& value, std::string place, Faults& faults)
      : object_(value), place_(std::move(place)), faults_(faults) {}
  ~ObjectReader();
  ObjectReader(const ObjectReader&) = delete;
  ObjectReader& operator=(const ObjectReader&) = delete;

  bool has(std::string_view key) const { return object_.contains(key); }
  std::vector<std::string> keys() const;
  /// Value of a key; null if absent.
  const nlohmann::json* content(std::string_view key) const;
  /// Marks a key as read elsewhere.
  void known(std::string_view key) { known_.emplace(key); }
  Faults& faults() { return faults_; }
  /// Path of a key of this object.
  std::string place(std::string_view key) const { return joined(place_, key); }
  const std::string& place() const { return place_; }
  void fault(std::string_view key, std::string what, std::string remedy);

  /// target = number in the file / `per_si`, e.g. 1000 for millimetres to metres. `range`: in the key's unit.
  bool number(const Key& key, double& target, const Range& range, Need need, double per_si = 1);
  /// Optional key; written if there is a value.
  bool optional_number(const Key& key, std::optional<double>& target, const Range& range);
  /// Object derived on writing, unchecked on reading. `written()`: JSON to write, null for nothing. `body(fields,
  /// key)`: describes it to the schema.
  void derived_object(const Key& key, auto, auto) { known(key); }
  /// Null, or an absent optional key, resets the target.
  bool nullable_number(const Key& key, std::optional<double>& target, const Range& range, Need need);
  bool integer(const Key& key, int& target, int smallest, int largest, Need need);
  bool integer(const Key& key, std::uint64_t& target, Need need);
  bool text(const Key& key, std::string& target, Need need);
  bool flag(const Key& key, bool& target, Need need);
  /// List of at least `least` and, unless `most` is 0, at most `most` numbers.
  bool numbers(const Key& key, std::vector<double>& target, const Range& range, Need need, std::size_t least,
               std::size_t most = 0);
  /// List of at least `least` pairs [first, second] with ascending first numbers.
  bool pairs(const Key& key, std::vector<std::array<double, 2>>& target, const Range& first, const Range& second,
             Need need, std::size_t least);
  bool texts(const Key& key, std::vector<std::string>& target, Need need);
  /// List of integers from 0, exact up to 64 bits (seeds).
  bool integers(const Key& key, std::vector<std::uint64_t>& target, Need need);
  template <class T, std::size_t N>
  bool choice(const Key& key, auto& target, const std::array<Named<T>, N>& words, Need need) {
    std::array<std::string_view, N> names;
    for (std::size_t n = 0; n < N; ++n) names[n] = words[n].name;
    const std::optional<std::size_t> found = word(key, names, need);
    if (found) target = words[*found].value;
    return found.has_value();
  }
  /// Calls `body(ObjectReader&)` for a nested object. `remedy`: advice for other values; default: the keys that `body`
  /// reads.
  bool object(const Key& key, Need need, auto body, std::string_view remedy = "") {
    const nlohmann::json* value = find_object(key, need, remedy, body);
    if (!value) return false;
    ObjectReader reader(*value, place(key), faults_);
    body(reader);
    return true;
  }
  /// As `object`, into `target`. Null resets it; an absent optional key leaves it unchanged.
  template <class T>
  bool nullable_object(const Key& key, std::optional<T>& target, Need need, auto body) {
    if (const nlohmann::json* value = content(key); value && value->is_null()) {
      known(key);
      target.reset();
      return true;
    }
    const auto probing = [&](ObjectReader& probe) {
      T unused{};
      body(probe, unused);
    };
    const nlohmann::json* found = find_object(key, need, "", probing, ", or null");
    if (!found) return false;
    if (!target) target.emplace();
    ObjectReader reader(*found, place(key), faults_);
    body(reader, *target);
    return true;
  }
  template <class T>
  bool optional_object(const Key& key, std::optional<T>& target, auto body) {
    return nullable_object(key, target, Need::optional, body);
  }
  /// List of objects, each described by `body(fields, one)`. A required list has at least one, an optional one is
  /// omitted if empty.
  template <class T>
  void list(const Key& key, std::vector<T>& target, Need need, auto body) {
    for_each_object(key, need, [&](ObjectReader& entry) { body(entry, target.emplace_back()); });
  }
  /// Object with arbitrary keys, each described by `body(fields, Key(one.*name), one)`.
  template <class T>
  bool entries(const Key& key, std::vector<T>& target, std::string T::*name, Need need, auto body) {
    return object(key, need, [&](ObjectReader& entries) {
      for (const std::string& own : entries.keys()) {
        T& one = target.emplace_back();
        one.*name = own;
        body(entries, Key(own), one);
      }
    });
  }
  /// Name of an object type that occurs several times; the schema defines it once.
  void shared(std::string_view) {}
  /// Reports a key that is valid elsewhere, or was in earlier versions, but not here.
  void refuse(std::string_view key, std::string what, std::string remedy);

 private:
  const nlohmann::json* find(std::string_view key, Need need);
  template <class T>
  bool value_of_kind(const Key& key, T& target, Need need, bool (nlohmann::json::*is_kind)() const noexcept,
                     const char* remedy);
  template <class T>
  bool list_of_kind(const Key& key, std::vector<T>& target, Need need, bool (nlohmann::json::*is_kind)() const noexcept,
                    const char* remedy);
  void for_each_object(const Key& key, Need need, const std::function<void(ObjectReader&)>& body);
  /// Object at a key. Other values are a fault with `remedy`, or with the keys that `body` reads and `instead`, the
  /// alternatives.
  const nlohmann::json* find_object(std::string_view key, Need need, std::string_view remedy, const auto& body,
                                    std::string_view instead = "") {
    const nlohmann::json* value = find(key, need);
    if (!value || value->is_object()) return value;
    std::string words(remedy);
    if (words.empty()) {
      static const nlohmann::json nothing = nlohmann::json::object();
      const std::size_t before = faults_.size();
      Faults of_missing_keys;
      ObjectReader probe(nothing, "", of_missing_keys);
      body(probe);
      faults_.resize(before);  // discards faults that the body adds elsewhere
      words = remedy_of(*value, probe.known_) + std::string(instead);
    }
    fault(key, "is " + text_of(*value), std::move(words));
    return nullptr;
  }
  /// Advice for a value that is not an object with these keys.
  static std::string remedy_of(const nlohmann::json& value, const Names& keys);
  /// Index of the word; a fault if there is none.
  std::optional<std::size_t> word(std::string_view key, std::span<const std::string_view> words, Need need);
  bool check_number(std::string_view place, const nlohmann::json& value, const Range& range);

  const nlohmann::json& object_;
  std::string place_;
  Faults& faults_;
  Names known_;
};

/// Reads a document of this format by `body(ObjectReader&)`. Returns every fault, with its place.
Faults read_document(const nlohmann::json& document, std::string_view format, auto body) {
  Faults faults;
  if (has_format(document, format, faults)) {
    ObjectReader reader(document, "", faults);
    reader.known("format");
    body(reader);
  }
  return faults;
}

/// `entries` whose values are objects, each described by `body(fields, one)`.
void named_objects(auto& fields, const Key& key, auto& list, auto name, auto when, auto body) {
  fields.entries(key, list, name, when, [&](auto& entries, const Key& own, auto& one) {
    entries.object(own, Need::required, [&](auto& entry) { body(entry, one); });
  });
}

}  // namespace pastefit
