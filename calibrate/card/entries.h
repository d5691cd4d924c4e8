#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/base/json_reader.h"

namespace pastefit {

/// Calls `body(reader, name)` for every entry of an object whose keys are names of the card's own.
template <class Body>
void each_entry(ObjectReader& reader, const nlohmann::json& object, Body body) {
  if (!object.is_object()) return;
  for (const auto& [name, value] : object.items())
    reader.object(name, Need::required, [&, key = name](ObjectReader& entry) { body(entry, key); });
}

/// A list of objects, absent when it would be empty.
template <class T, class Read>
void read_objects(ObjectReader& card, const nlohmann::json& document, const char* key, std::vector<T>& target,
                  Read read) {
  card.known(key);
  const auto list = document.find(key);
  if (list == document.end()) return;
  if (!list->is_array()) return card.fault(key, "is no list", "a list of objects [ { ... } ]");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto place = std::string(key) + "[" + std::to_string(i) + "]";
    if (!(*list)[i].is_object()) {
      card.fault(place, "is no object", "an object { ... }");
      continue;
    }
    ObjectReader entry((*list)[i], place, card.faults());
    read(entry, (*list)[i], target.emplace_back());
  }
}

}  // namespace pastefit
