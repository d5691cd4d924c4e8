#pragma once

#include <string>
#include <string_view>

namespace pastefit {

/// Bytes as text of 64 letters, four for each three bytes, the last ones filled up with "=" (RFC 4648).
std::string base64(std::string_view bytes);

}  // namespace pastefit
