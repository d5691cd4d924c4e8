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

/// Parses JSON text; `//` and `/* */` comments are allowed. Appends to `faults`:
/// text that is not JSON (with line and column), and keys that stand twice in one object (with the object's place).
/// Returns nothing only if there is no document; twice-given keys are faults, but the document is still read,
/// so that its other faults can be named too. Nesting beyond 32 levels counts as "not JSON".
std::optional<nlohmann::json> parse_json(std::string_view text, Faults& faults);

/// Reads a file of at most 16 MB with `parse_json`; a file that cannot be read is a fault too.
std::optional<nlohmann::json> read_json(const std::filesystem::path& file, Faults& faults);

/// What `from_json` makes of the file's content, a `Result`; its faults begin with the file's name.
template <class FromJson>
auto read_file(const std::filesystem::path& file, const FromJson& from_json)
    -> decltype(from_json(std::declval<nlohmann::json&>())) {
  Faults faults;
  auto document = read_json(file, faults);
  if (!document) return faults;
  auto read = from_json(*document);
  if (read.ok() && faults.empty()) return read;
  if (!read.ok())
    for (Fault& fault : in_file(read.faults(), file)) faults.push_back(std::move(fault));
  return faults;
}

/// Whether the document's "format" is the expected one, e.g. "pastefit-lab-1".
/// False only if going on makes no sense: it is no object, or another kind of pastefit file.
bool has_format(const nlohmann::json& document, std::string_view expected, Faults& faults);

/// The value as a fault names it: numbers and texts as they are, "an object", "a list" or "null".
std::string text_of(const nlohmann::json& value);

class ObjectSchema;

/// "must be 1 to 5000 mm", for remedies.
std::string text_of(const Range& range, std::string_view unit = "");

/// Reads one JSON object strictly, into variables that keep their value when the key is absent or wrong.
/// Each call names one key, with all that is known of it; that call is the only description of the field.
/// The reader's end reports every key of the object that no call has named.
/// All readers return whether the variable was set.
class ObjectReader {
 public:
  static constexpr bool reads = true;
  /// `value` must be an object and outlive the reader; `place` is its path, empty for the document itself.
  ObjectReader(const nlohmann::json& value, std::string place, Faults& faults);
  ~ObjectReader();
  ObjectReader(const ObjectReader&) = delete;
  ObjectReader& operator=(const ObjectReader&) = delete;

  bool has(std::string_view key) const;
  std::vector<std::string> keys() const;
  /// What stands there; null if nothing does.
  const nlohmann::json* content(std::string_view key) const;
  /// A key of earlier programs is a fault that says what stands in its place.
  void former(std::string_view key, std::string instead);
  /// Names a key that was read elsewhere.
  void known(std::string_view key) { known_.emplace(key); }
  Faults& faults() { return faults_; }
  /// The path of a key of this object.
  std::string place(std::string_view key) const;
  /// Of the object itself.
  const std::string& place() const { return place_; }
  void fault(std::string_view key, std::string what, std::string remedy);

  /// target = number in the file / `per_si`, e.g. 1000 for millimetres into metres. `range` is in the key's unit.
  bool number(const Key& key, double& target, const Range& range, Presence presence, double per_si = 1);
  /// An optional key, which is written if there is a value.
  bool optional_number(const Key& key, std::optional<double>& target, const Range& range);
  bool optional_flag(const Key& key, std::optional<bool>& target);
  /// Derived on writing; checked, but not read.
  void derived_number(const Key& key, const std::optional<double>&, const Range& range) {
    double unused = 0;
    number(key, unused, range, Need::optional);
  }
  /// The same of an object, which is not checked: `written()` is what to write, null for nothing; `body(fields, key)`
  /// describes it to the schema.
  template <class Written, class Body>
  void derived_object(const Key& key, Written, Body) {
    known(key);
  }
  /// Null and an absent optional key empty the target.
  bool nullable_number(const Key& key, std::optional<double>& target, const Range& range, Need need);
  bool integer(const Key& key, int& target, int smallest, int largest, Presence presence);
  bool integer(const Key& key, std::uint64_t& target, Need need);
  bool text(const Key& key, std::string& target, Presence presence);
  bool flag(const Key& key, bool& target, Presence presence);
  /// A list of at least `least` numbers and, if `most` is not 0, at most that many.
  bool numbers(const Key& key, std::vector<double>& target, const Range& range, Need need, std::size_t least,
               std::size_t most = 0);
  /// A list of at least `least` pairs of numbers [first, second], the first ones ascending.
  bool pairs(const Key& key, std::vector<std::array<double, 2>>& target, const Range& first, const Range& second,
             Need need, std::size_t least);
  bool texts(const Key& key, std::vector<std::string>& target, Need need);
  /// A list of whole numbers from 0, exact up to 64 bits (seeds).
  bool integers(const Key& key, std::vector<std::uint64_t>& target, Need need);
  template <class Target, class T, std::size_t N>
  bool choice(const Key& key, Target& target, const std::array<Named<T>, N>& words, Presence presence);
  /// Calls `body(ObjectReader&)` for an object of this object. `remedy` is what to write where it is none; without one
  /// the keys that `body` reads are named.
  template <class Body>
  bool object(const Key& key, Presence presence, Body body, std::string_view remedy = "");
  /// As `object`, into `target`; null empties it, and an absent optional key leaves it as it is.
  template <class T, class Body>
  bool nullable_object(const Key& key, std::optional<T>& target, Need need, Body body);
  /// As `nullable_object` of an optional key.
  template <class T, class Body>
  bool optional_object(const Key& key, std::optional<T>& target, Body body) {
    return nullable_object(key, target, Need::optional, body);
  }
  /// A list of objects, `body(fields, one)` each; a required one has at least one, an optional one is left out when it
  /// would be empty.
  template <class T, class Body>
  void list(const Key& key, std::vector<T>& target, Need need, Body body);
  /// An object whose keys are names of its own, `body(fields, Key(one.*name), one)` each.
  template <class T, class Body>
  bool entries(const Key& key, std::vector<T>& target, std::string T::*name, Presence presence, Body body);
  /// An object with some of these keys, for each of which `body` names the same field to `fields`.
  template <class List, class Body>
  bool known_entries(const Key& key, List& list, Need need, Body body);
  /// Of an object that stands in several places: the schema describes it once, by this name.
  void shared(std::string_view) {}
  /// Names a key that is sensible elsewhere but not here: a fault with this remedy if it is present.
  void refuse(std::string_view key, std::string what, std::string remedy);

 private:
  const nlohmann::json* find(std::string_view key, Need need);
  template <class T>
  bool value_of_kind(const Key& key, T& target, Presence presence, bool (nlohmann::json::*is_kind)() const noexcept,
                     const char* remedy);
  template <class T>
  bool list_of_kind(const Key& key, std::vector<T>& target, Need need, bool (nlohmann::json::*is_kind)() const noexcept,
                    const char* remedy);
  void for_each_object(const Key& key, Need need, const std::function<void(ObjectReader&)>& body);
  /// The object at a key. In the place of another value a fault with the remedy, or with the keys that `body` reads and
  /// `instead`, what else may stand there.
  template <class Body>
  const nlohmann::json* find_object(std::string_view key, Need need, std::string_view remedy, const Body& body,
                                    std::string_view instead = "");
  /// What to write in the place of a value that is no object with these keys.
  static std::string remedy_of(const nlohmann::json& value, const std::set<std::string, std::less<>>& keys);
  /// Which of the words it is; a fault if none.
  std::optional<std::size_t> word(std::string_view key, std::span<const std::string_view> words, Need need);
  static bool is_object(const nlohmann::json& value);
  static const nlohmann::json& nothing();  ///< an object without keys
  /// Whether the key is there and null.
  bool null(std::string_view key);
  bool check_number(std::string_view place, const nlohmann::json& value, const Range& range);

  const nlohmann::json& object_;
  std::string place_;
  Faults& faults_;
  std::set<std::string, std::less<>> known_;
};

template <class Target, class T, std::size_t N>
bool ObjectReader::choice(const Key& key, Target& target, const std::array<Named<T>, N>& words, Presence presence) {
  std::array<std::string_view, N> names;
  for (std::size_t n = 0; n < N; ++n) names[n] = words[n].name;
  const std::optional<std::size_t> found = word(key, names, presence);
  if (found) target = words[*found].value;
  return found.has_value();
}

template <class Body>
const nlohmann::json* ObjectReader::find_object(std::string_view key, Need need, std::string_view remedy,
                                                const Body& body, std::string_view instead) {
  const nlohmann::json* value = find(key, need);
  if (!value || is_object(*value)) return value;
  std::string words(remedy);
  if (words.empty()) {
    const std::size_t before = faults_.size();
    Faults of_missing_keys;
    ObjectReader probe(nothing(), "", of_missing_keys);
    body(probe);
    faults_.resize(before);  // without what the body says of them elsewhere
    words = remedy_of(*value, probe.known_) + std::string(instead);
  }
  fault(key, "is " + text_of(*value), std::move(words));
  return nullptr;
}

template <class Body>
bool ObjectReader::object(const Key& key, Presence presence, Body body, std::string_view remedy) {
  const nlohmann::json* value = find_object(key, presence, remedy, body);
  if (!value) return false;
  ObjectReader reader(*value, place(key), faults_);
  body(reader);
  return true;
}

template <class T, class Body>
bool ObjectReader::nullable_object(const Key& key, std::optional<T>& target, Need need, Body body) {
  if (null(key)) {
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

template <class T, class Body>
void ObjectReader::list(const Key& key, std::vector<T>& target, Need need, Body body) {
  for_each_object(key, need, [&](ObjectReader& entry) { body(entry, target.emplace_back()); });
}

template <class T, class Body>
bool ObjectReader::entries(const Key& key, std::vector<T>& target, std::string T::*name, Presence presence, Body body) {
  return object(key, presence, [&](ObjectReader& entries) {
    for (const std::string& own : entries.keys()) {
      T& one = target.emplace_back();
      one.*name = own;
      body(entries, Key(own), one);
    }
  });
}

template <class List, class Body>
bool ObjectReader::known_entries(const Key& key, List& list, Need need, Body body) {
  return object(key, need, [&](ObjectReader& entries) {
    for (auto& one : list) body(entries, one);
  });
}

/// `entries` that are objects: `body(fields, one)` describes each.
template <class Fields, class List, class Name, class When, class Body>
void named_objects(Fields& fields, const Key& key, List& list, Name name, When when, Body body) {
  fields.entries(key, list, name, when, [&](auto& entries, const Key& own, auto& one) {
    entries.object(own, Need::required, [&](auto& entry) { body(entry, one); });
  });
}

}  // namespace pastefit
