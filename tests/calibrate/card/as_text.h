#pragma once

#include <nlohmann/json.hpp>

namespace pastefit {

/// What a reader finds of a document that was written to a file.
inline nlohmann::json text_and_back(const nlohmann::ordered_json& json) {
  return nlohmann::json::parse(json.dump(2));
}

}  // namespace pastefit
