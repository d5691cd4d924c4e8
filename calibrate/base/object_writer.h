#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"

namespace pastefit {

/// Writes what an `ObjectReader` reads, by the same calls, so that one description serves both.
template <class Json>
class BasicObjectWriter {
 public:
  static constexpr bool reads = false;
  explicit BasicObjectWriter(Json& object) : object_(object) { object_ = Json::object(); }

  void number(const Key& key, double value, const Range&, auto when) { put(key, value, when); }
  void nullable_number(const Key& key, const std::optional<double>& value, const Range&, Need) {
    at(key) = value ? Json(*value) : Json();
  }
  void optional_number(const Key& key, const std::optional<double>& value, const Range&) {
    if (value) at(key) = *value;
  }
  void integer(const Key& key, std::uint64_t value, Need) { at(key) = value; }
  void integer(const Key& key, int value, int, int, auto when) { put(key, value, when); }
  void text(const Key& key, std::string_view value, auto when) { put(key, value, when); }
  void flag(const Key& key, bool value, auto when) { put(key, value, when); }
  void numbers(const Key& key, const std::vector<double>& value, const Range&, Need, std::size_t, std::size_t = 0) {
    at(key) = value;
  }
  void integers(const Key& key, const std::vector<std::uint64_t>& value, Need) { at(key) = value; }
  void texts(const Key& key, const std::vector<std::string>& value, Need need) {
    if (need == Need::required || !value.empty()) at(key) = value;
  }
  void pairs(const Key& key, const std::vector<std::array<double, 2>>& value, const Range&, const Range&, Need,
             std::size_t) {
    if (!value.empty()) at(key) = value;
  }
  template <class Target, class T, std::size_t N, class When>
  void choice(const Key& key, const Target& value, const std::array<Named<T>, N>& words, When when) {
    if (!is_written(value, when)) return;
    for (const Named<T>& word : words)
      if (word.value == value) at(key) = word.name;
  }
  void object(const Key& key, auto when, auto body) {
    if (!is_written(0, when)) return;
    BasicObjectWriter writer(at(key));
    body(writer);
  }
  template <class T, class Body>
  void nullable_object(const Key& key, const std::optional<T>& value, Need, Body body) {
    at(key) = Json();
    if (!value) return;
    BasicObjectWriter writer(at(key));
    body(writer, *value);
  }
  template <class T, class Body>
  void optional_object(const Key& key, const std::optional<T>& value, Body body) {
    if (value) nullable_object(key, value, Need::optional, body);
  }
  void derived_object(const Key& key, auto written, auto) {
    if (auto object = written(); !object.is_null()) at(key) = std::move(object);
  }
  template <class T, class Body>
  void list(const Key& key, const std::vector<T>& value, Need need, Body body) {
    if (need == Need::optional && value.empty()) return;
    at(key) = Json::array();
    for (const T& one : value) {
      BasicObjectWriter writer(at(key).emplace_back());
      body(writer, one);
    }
  }
  template <class T, class When, class Body>
  void entries(const Key& key, const std::vector<T>& value, std::string T::*name, When when, Body body) {
    object(key, when, [&](BasicObjectWriter& writer) {
      for (const T& one : value) body(writer, Key(one.*name), one);
    });
  }
  void shared(std::string_view) {}

 private:
  Json& at(const Key& key) { return object_[std::string(key.name)]; }
  void put(const Key& key, const auto& value, auto when) {
    if (is_written(value, when)) at(key) = value;
  }
  static bool is_written(const auto&, Need) { return true; }
  template <class T, class By>
  static bool is_written(const T& value, const Default<By>& by_default) {
    return value != by_default.value;
  }
  static bool is_written(const auto&, With with) { return with.there; }
  static bool is_written(const auto&, WrittenIf written) { return written.holds; }

  Json& object_;
};

using ObjectWriter = BasicObjectWriter<nlohmann::json>;
using OrderedObjectWriter = BasicObjectWriter<nlohmann::ordered_json>;  ///< keeps the order of the calls

}  // namespace pastefit
