#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/base/json_reader.h"

namespace pastefit {

/// Generates the JSON schema (draft 7) of what an `ObjectReader` reads, by the same calls. Values of arguments are
/// ignored, as any object of the kind will do.
class ObjectSchema {
 public:
  using Json = nlohmann::ordered_json;
  static constexpr bool reads = false;
  /// Schema of a document, or of a part of one.
  ObjectSchema() : ObjectSchema(std::make_shared<Json>()) {}
  /// Schema of a file of this format.
  explicit ObjectSchema(std::string_view format);

  void number(const Key& key, double, const Range& range, Need need, double = 1) { put(key, number_in(range), need); }
  void nullable_number(const Key& key, const std::optional<double>&, const Range& range, Need need) {
    put(key, or_null(number_in(range)), need);
  }
  void optional_number(const Key& key, const std::optional<double>&, const Range& range) {
    put(key, number_in(range), Need::optional);
  }
  void integer(const Key& key, std::uint64_t, Need need) { put(key, any_whole_number(), need); }
  void integer(const Key& key, int, int smallest, int largest, Need need) {
    put(key, {{"type", "integer"}, {"minimum", smallest}, {"maximum", largest}}, need);
  }
  void text(const Key& key, std::string_view, Need need) { put(key, {{"type", "string"}}, need); }
  /// Text with a fixed value.
  void constant(const Key& key, std::string_view value, Need need) { put(key, {{"const", value}}, need); }
  void flag(const Key& key, bool, Need need) { put(key, {{"type", "boolean"}}, need); }
  void numbers(const Key& key, const std::vector<double>&, const Range& range, Need need, std::size_t least,
               std::size_t most = 0);
  void integers(const Key& key, const std::vector<std::uint64_t>&, Need need) {
    put(key, list_of(any_whole_number()), need);
  }
  void texts(const Key& key, const std::vector<std::string>&, Need need) {
    put(key, list_of({{"type", "string"}}), need);
  }
  void pairs(const Key& key, const std::vector<std::array<double, 2>>&, const Range& first, const Range& second,
             Need need, std::size_t least);
  template <class Target, class T, std::size_t N>
  void choice(const Key& key, const Target&, const std::array<Named<T>, N>& words, Need need) {
    Json names = Json::array();
    for (const Named<T>& word : words) names.push_back(word.name);
    put(key, key.schema.empty() ? Json{{"enum", names}} : Json{{"$ref", key.schema}}, need);
  }
  void object(const Key& key, Need need, auto body) { put(key, described(body), need); }
  template <class T, class Body>
  void nullable_object(const Key& key, const std::optional<T>&, Need need, Body body) {
    T any{};
    put(key, or_null(described([&](ObjectSchema& inner) { body(inner, any); })), need);
  }
  template <class T, class Body>
  void optional_object(const Key& key, const std::optional<T>& value, Body body) {
    nullable_object(key, value, Need::optional, body);
  }
  void derived_object(const Key& key, auto, auto body) { body(*this, key); }
  template <class T, class Body>
  void list(const Key& key, const std::vector<T>&, Need need, Body body) {
    T any{};
    Json schema{{"type", "array"}};
    if (need == Need::required) schema["minItems"] = 1;
    schema["items"] = described([&](ObjectSchema& inner) { body(inner, any); });
    put(key, std::move(schema), need);
  }
  template <class T, class Body>
  void entries(const Key& key, const std::vector<T>&, std::string T::*, Need need, Body body) {
    T any{};
    const Json entry = described([&](ObjectSchema& inner) { body(inner, Key("NAME"), any); });
    put(key, {{"type", "object"}, {"additionalProperties", entry.at("properties").at("NAME")}}, need);
  }
  /// Object with some of the keys that `body` describes, all alike.
  void known_entries(const Key& key, Need need, auto body) { put_known(key, described(body).at("properties"), need); }
  /// Object of numbers with arbitrary keys.
  void any_numbers(const Key& key, const Range& range) {
    put(key, {{"type", "object"}, {"additionalProperties", number_in(range)}}, Need::optional);
  }
  void shared(std::string_view name) { shared_ = name; }
  /// Adds a property with a given schema, for objects with several forms.
  void put(const Key& key, Json schema, Need need);
  /// Adds a schema to the definitions, and returns a reference to it.
  Json defined(const std::string& name, Json schema);
  /// Schema of what `body(ObjectSchema&)` describes.
  Json described(auto body) {
    ObjectSchema inner(definitions_);
    body(inner);
    return inner.shared_.empty() ? std::move(inner.object_) : defined(inner.shared_, std::move(inner.object_));
  }
  /// What is described so far, for rules that the methods do not have.
  Json& described() { return object_; }
  /// The whole schema, with the definitions of its `shared` objects.
  Json document(std::string_view title, std::string_view description) const;

 private:
  explicit ObjectSchema(std::shared_ptr<Json> definitions);
  static Json number_in(const Range& range);
  static Json any_whole_number();
  static Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
  static Json or_null(Json schema);
  void put_known(const Key& key, const Json& entries, Need need);

  Json object_;
  std::shared_ptr<Json> definitions_;  // one for all parts of a document
  std::string shared_;
};

}  // namespace pastefit
