#include "calibrate/base/foreign_text.h"

#include <cstdint>
#include <nlohmann/json.hpp>

namespace pastefit {

namespace {

constexpr std::string_view no_character = "\xEF\xBF\xBD";  // U+FFFD

/// A character and the bytes that it takes; 0 bytes where there is none.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};

/// The first character of a text that is not empty.
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t bytes = byte(0) >= 0xC2 && byte(0) < 0xE0   ? 2
                            : byte(0) >= 0xE0 && byte(0) < 0xF0 ? 3
                            : byte(0) >= 0xF0 && byte(0) < 0xF5 ? 4
                                                                : 0;
  if (bytes == 0 || text.size() < bytes) return {};
  std::uint32_t code = byte(0) & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool too_long = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  const bool no_letter = (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF;
  return too_long || no_letter ? Character{} : Character{code, bytes};
}

/// Controls, separators of lines, and what turns the direction of writing.
bool is_control(std::uint32_t code) {
  const auto within = [&](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
  return code < 0x20 || within(0x7F, 0x9F) || within(0x200E, 0x200F) || within(0x2028, 0x202E) ||
         within(0x2066, 0x2069) || within(0xFFFE, 0xFFFF);
}

/// The text, characters that `replacement` names replaced by what it answers; it answers null for what stays.
template <class Replacement>
std::string replaced(std::string_view text, Replacement replacement) {
  std::string out;
  while (!text.empty()) {
    const Character next = first_of(text);
    if (next.bytes == 0) {
      out += no_character;
      text.remove_prefix(1);
      continue;
    }
    if (const char* other = replacement(next.code))
      out += other;
    else
      out += is_control(next.code) ? " " : text.substr(0, next.bytes);
    text.remove_prefix(next.bytes);
  }
  return out;
}

}  // namespace

std::string one_line(std::string_view text) {
  return replaced(text, [](std::uint32_t) -> const char* { return nullptr; });
}

std::string lines_of(std::string_view text) {
  return replaced(text, [](std::uint32_t code) { return code == '\n' ? "\n" : code == '\t' ? "\t" : nullptr; });
}

std::string deck_comment(std::string_view text) {
  return "# " +
         replaced(text,
                  [](std::uint32_t code) -> const char* {
                    switch (code) {
                      case '"':
                      case '`':
                        return "'";
                      case '&':
                        return "+";
                      case '$':
                      case '\\':
                        return "/";
                      default:
                        return nullptr;
                    }
                  }) +
         "\n";
}

std::string xml_text(std::string_view text) {
  return replaced(text, [](std::uint32_t code) -> const char* {
    switch (code) {
      case '&':
        return "&amp;";
      case '<':
        return "&lt;";
      case '>':
        return "&gt;";
      case '"':
        return "&quot;";
      case '\'':
        return "&apos;";
      case '\n':
        return "&#10;";
      default:
        return nullptr;
    }
  });
}

std::string json_text(const nlohmann::ordered_json& value) {
  const auto text = [&](bool only_ascii) {
    return value.dump(2, ' ', only_ascii, nlohmann::json::error_handler_t::replace) + "\n";
  };
  std::string out = text(false);
  return lines_of(out) == out ? out : text(true);
}

std::string json_in_html(const nlohmann::ordered_json& value) {
  std::string out;
  for (const char letter : value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)) {
    // Outside of its texts JSON has none of these.
    if (letter == '<' || letter == '>' || letter == '&')
      out += letter == '<' ? "\\u003c" : letter == '>' ? "\\u003e" : "\\u0026";
    else
      out += letter;
  }
  return out;
}

}  // namespace pastefit
