#include "calibrate/base/object_schema.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pastefit {
namespace {

using Json = ObjectSchema::Json;

Json number_of(double value) {
  const bool whole = value == std::round(value) && std::abs(value) < largest_quantity;
  return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

}  // namespace

ObjectSchema::ObjectSchema(std::shared_ptr<Json> definitions) : definitions_(std::move(definitions)) {
  object_ = {{"type", "object"}, {"additionalProperties", false}};
  object_["properties"] = Json::object();
}

ObjectSchema::ObjectSchema(std::string_view format) : ObjectSchema() {
  constant({"format", "kind of file and version of its format"}, format, Need::required);
}

Json ObjectSchema::number_in(const Range& range) {
  return {{"type", "number"},
          {range.open ? "exclusiveMinimum" : "minimum", number_of(range.smallest)},
          {"maximum", number_of(range.largest)}};
}

Json ObjectSchema::any_whole_number() {
  return {{"type", "integer"}, {"minimum", 0}, {"maximum", std::numeric_limits<std::uint64_t>::max()}};
}

void ObjectSchema::numbers(const Key& key, const std::vector<double>&, const Range& range, Need need, std::size_t least,
                           std::size_t most) {
  Json schema = list_of(number_in(range));
  if (least > 0) schema["minItems"] = least;
  if (most > 0) schema["maxItems"] = most;
  put(key, std::move(schema), need);
}

void ObjectSchema::pairs(const Key& key, const std::vector<std::array<double, 2>>&, const Range& first,
                         const Range& second, Need need, std::size_t least) {
  Json pair = list_of(number_in({std::min(first.smallest, second.smallest), std::max(first.largest, second.largest)}));
  pair["minItems"] = pair["maxItems"] = 2;
  Json schema = list_of(std::move(pair));
  if (least > 0) schema["minItems"] = least;
  put(key, std::move(schema), need);
}

void ObjectSchema::put(const Key& key, Json schema, Need need) {
  const std::string name(key.name);
  Json& property = object_["properties"][name] = Json::object();
  if (!key.meaning.empty()) property["description"] = key.meaning;
  for (auto& [word, value] : schema.items()) property[word] = std::move(value);
  if (need == Need::required) object_["required"].push_back(name);
}

Json ObjectSchema::defined(const std::string& name, Json object) {
  (*definitions_)[name] = std::move(object);
  return {{"$ref", "#/definitions/" + name}};
}

Json ObjectSchema::or_null(Json schema) {
  if (!schema.contains("type")) return {{"anyOf", {schema, {{"type", "null"}}}}};
  schema["type"] = {schema["type"], "null"};
  return schema;
}

void ObjectSchema::put_known(const Key& key, const Json& entries, Need need) {
  Json names = Json::array();
  for (const auto& [name, schema] : entries.items()) names.push_back(name);
  put(key, {{"type", "object"}, {"propertyNames", {{"enum", names}}}, {"additionalProperties", entries.front()}}, need);
}

Json ObjectSchema::document(std::string_view title, std::string_view description) const {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}, {"description", description}};
  for (const auto& [word, value] : object_.items()) schema[word] = value;
  if (!definitions_->is_null()) schema["definitions"] = *definitions_;
  return schema;
}

}  // namespace pastefit
