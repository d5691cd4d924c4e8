#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "calibrate/base/json_reader.h"

namespace pastefit {

/// Writes what an `ObjectReader` reads, with the same calls, so that one description serves both ways.
class ObjectWriter {
 public:
  explicit ObjectWriter(nlohmann::json& object) : object_(object) { object_ = nlohmann::json::object(); }

  void number(const char* key, double value, const Range&, Need) { object_[key] = value; }
  void number(const char* key, double value, const Range& range, Default<double> by_default) {
    if (value != by_default.value) number(key, value, range, Need::optional);
  }
  void nullable_number(const char* key, const std::optional<double>& value, const Range&, Need) {
    object_[key] = value ? nlohmann::json(*value) : nlohmann::json();
  }
  void integer(const char* key, std::uint64_t value, Need) { object_[key] = value; }
  void integer(const char* key, int value, int, int, Default<int> by_default) {
    if (value != by_default.value) object_[key] = value;
  }
  void pairs(const char* key, const std::vector<std::array<double, 2>>& value, const Range&, const Range&, Need,
             std::size_t) {
    if (!value.empty()) object_[key] = value;
  }
  template <class T, std::size_t N>
  void choice(const char* key, T value, const std::array<Named<T>, N>& words, Need) {
    for (const Named<T>& word : words)
      if (word.value == value) object_[key] = word.name;
  }
  template <class T, std::size_t N>
  void choice(const char* key, T value, const std::array<Named<T>, N>& words, Default<T> by_default) {
    if (value != by_default.value) choice(key, value, words, Need::optional);
  }
  template <class Body>
  void object(const char* key, Need, Body body) {
    ObjectWriter writer(object_[key]);
    body(writer);
  }
  template <class T, class Body>
  void nullable_object(const char* key, const std::optional<T>& value, Need, Body body) {
    object_[key] = nlohmann::json();
    if (!value) return;
    ObjectWriter writer(object_[key]);
    body(writer, *value);
  }
  /// Left out where there is none.
  template <class T, class Body>
  void optional_object(const char* key, const std::optional<T>& value, Body body) {
    if (value) nullable_object(key, value, Need::optional, body);
  }

 private:
  nlohmann::json& object_;
};

}  // namespace pastefit
