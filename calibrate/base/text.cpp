#include "calibrate/base/text.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>
#include <vector>

namespace pastefit {

namespace {

using nlohmann::json;

/// Number of characters: continuation bytes in UTF-8 begin with 10.
std::size_t letters_in(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

/// Indentation of continuation lines.
std::size_t hanging_indent(std::string_view line, std::size_t columns) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = std::min(line.find("  ", begin), line.size());
  const std::size_t second = std::min(line.find_first_not_of(' ', gap), line.size());
  const std::size_t column = letters_in(line.substr(0, second));
  return second < line.size() && column <= columns / 2 ? column : begin + 2;
}

/// True if the text around a blank is one number: "34.9 +- 6", "95 %".
bool within_number(std::string_view line, std::size_t blank) {
  const std::string_view before = line.substr(0, blank), after = line.substr(blank + 1);
  return after.starts_with('%') || after.starts_with("+- ") || before.ends_with("+-");
}

std::string wrapped_line(std::string_view line, std::size_t columns) {
  if (letters_in(line) <= columns) return std::string(line);
  const std::string indent(hanging_indent(line, columns), ' ');
  std::string out, row;
  bool has_word = false;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t word = std::min(line.find_first_not_of(' ', at), line.size());
    std::size_t end = line.find(' ', word);
    while (end < line.size() && within_number(line, end)) end = line.find(' ', end + 1);
    end = std::min(end, line.size());
    if (has_word && letters_in(row) + letters_in(line.substr(at, end - at)) > columns) {
      out += row + "\n";
      row = indent;
      at = word;
    }
    row += line.substr(at, end - at);
    has_word = true;
    at = end;
  }
  return out + row;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

constexpr std::string_view no_character = "\xEF\xBF\xBD";  // U+FFFD

/// Code point and its number of bytes; 0 bytes at the end.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};

/// First character of a non-empty text.
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

/// Control characters, line separators, and controls of writing direction.
bool is_control(std::uint32_t code) {
  const auto within = [&](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
  return code < 0x20 || within(0x7F, 0x9F) || within(0x200E, 0x200F) || within(0x2028, 0x202E) ||
         within(0x2066, 0x2069) || within(0xFFFE, 0xFFFF);
}

/// Character and its replacement.
using Replacement = std::pair<std::uint32_t, std::string_view>;

std::string replaced(std::string_view text, std::initializer_list<Replacement> replacements) {
  std::string out;
  while (!text.empty()) {
    const Character next = first_of(text);
    const auto other = std::ranges::find(replacements, next.code, &Replacement::first);
    out += next.bytes == 0               ? no_character
           : other != replacements.end() ? other->second
           : is_control(next.code)       ? " "
                                         : text.substr(0, next.bytes);
    text.remove_prefix(std::max<std::size_t>(next.bytes, 1));
  }
  return out;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string out;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out += wrapped_line(text.substr(0, end), columns);
    if (end == text.size()) return out;
    out += '\n';
    text.remove_prefix(end + 1);
  }
}

Faults in_file(Faults faults, const std::filesystem::path& file) {
  if (file.empty()) return faults;
  for (Fault& fault : faults) fault.where = file.string() + (fault.where.empty() ? "" : ": " + fault.where);
  return faults;
}

std::string message_of(const Faults& faults) {
  std::string message;
  for (const Fault& fault : faults) {
    if (!message.empty()) message += '\n';
    message += fault.where + (fault.where.empty() ? "" : ": ") + fault.what;
    if (!fault.remedy.empty()) message += "; " + fault.remedy;
  }
  return message;
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::string small_letters(std::string_view text) {
  std::string out(text);
  for (char& letter : out)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return out;
}

std::optional<std::string> nearest(std::string_view word, const Names& candidates) {
  constexpr std::size_t longest = 200;  // longer words are no typing errors, and the distance is quadratic
  if (word.size() > longest) return std::nullopt;
  const auto distance = [&](const std::string& candidate) {
    return edit_distance(small_letters(word), small_letters(candidate));
  };
  const auto best = std::ranges::min_element(candidates, {}, distance);
  if (best == candidates.end()) return std::nullopt;
  const std::size_t most = std::max<std::size_t>(2, std::max(word.size(), best->size()) / 2);
  return distance(*best) <= most ? std::optional(*best) : std::nullopt;
}

std::string did_you_mean(std::string_view word, const Names& known, const std::string& otherwise) {
  const std::optional<std::string> near = nearest(word, known);
  return near ? "did you mean " + in_quotes(*near) + "?" : otherwise;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  const std::string cut = text.size() > longest ? std::string(text.substr(0, longest)) + "..." : std::string(text);
  return json(cut).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string printable(std::string_view key) {
  const std::string text = in_quotes(key);
  return text.substr(1, text.size() - 2);
}

std::string joined(const std::string& place, std::string_view key) {
  return place.empty() ? std::string(key) : place + "." + std::string(key);
}

std::string one_line(std::string_view text) {
  return replaced(text, {});
}

std::string lines_of(std::string_view text) {
  return replaced(text, {{'\n', "\n"}, {'\t', "\t"}});
}

std::string deck_comment(std::string_view text) {
  return "# " + replaced(text, {{'"', "'"}, {'`', "'"}, {'&', "+"}, {'$', "/"}, {'\\', "/"}}) + "\n";
}

std::string xml_text(std::string_view text) {
  return replaced(text,
                  {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&apos;"}, {'\n', "&#10;"}});
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
    // JSON has none of these outside its strings.
    if (letter == '<' || letter == '>' || letter == '&')
      out += letter == '<' ? "\\u003c" : letter == '>' ? "\\u003e" : "\\u0026";
    else
      out += letter;
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= bytes.size() - i ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace pastefit
