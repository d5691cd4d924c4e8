#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pastefit {

/// FNV-1a, 64 bits, as 16 hexadecimal digits. Tells contents apart; no protection against intent.
/// Source: Fowler, Noll & Vo; offset basis 0xcbf29ce484222325, prime 0x100000001b3.
inline std::string content_hash(std::string_view content) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : content) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3u;
  }
  std::string digits(16, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4)
    *digit = "0123456789abcdef"[hash & 15];
  return digits;
}

}  // namespace pastefit
