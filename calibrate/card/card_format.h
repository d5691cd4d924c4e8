#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/result.h"

namespace pastefit {

/// The version of the card format that this program reads and writes.
inline constexpr int kCardVersion = 5;

/// Why a document is no card that this program reads: it says that it is none, or one of another version. Nothing if it
/// is one.
Faults card_format_faults(const nlohmann::json& document);

}  // namespace pastefit
