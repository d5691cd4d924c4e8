#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "calibrate/base/input_file.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"

namespace pastefit {
namespace {

using nlohmann::json;
constexpr std::size_t deepest_nesting = 32;  // pastefit's files need 4; the limit protects recursive writers

std::string line_and_column(std::string_view text, std::size_t bytes_read) {
  const std::string_view read = text.substr(0, bytes_read);
  const auto line = 1 + std::count(read.begin(), read.end(), '\n');
  const std::size_t line_end = read.rfind('\n');
  const std::size_t column = line_end == std::string_view::npos ? read.size() : read.size() - line_end - 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::size_t>(column, 1));
}

/// The parser's message without error number and position.
std::string complaint(const json::exception& error) {
  std::string text = error.what();
  text.erase(0, text.find("] ") + 2);
  if (const std::size_t column = text.find(", column "); column != std::string::npos)
    text.erase(0, text.find(": ", column) + 2);
  // The parser escapes control characters, but copies invalid bytes.
  std::erase_if(text, [](unsigned char byte) { return byte >= 0x80; });
  return text;
}

/// Character of word processors or other encodings in place of a JSON one, with explanation and remedy.
struct ForeignCharacter {
  std::string_view bytes, what, remedy;
};

constexpr std::array<ForeignCharacter, 9> foreign_characters{{
    {"\xC2\xA0", "a no-break space", "type a space in its place"},
    {"\xE2\x80\xAF", "a no-break space", "type a space in its place"},
    {"\xE2\x80\x9C", "a typographic quotation mark", "write \" in its place"},
    {"\xE2\x80\x9D", "a typographic quotation mark", "write \" in its place"},
    {"\xE2\x80\x9E", "a typographic quotation mark", "write \" in its place"},
    {"\xE2\x80\x98", "a typographic quotation mark", "write \" in its place"},
    {"\xE2\x80\x99", "a typographic quotation mark", "write \" in its place"},
    {"\xE2\x88\x92", "a typographic minus sign", "write - in its place"},
    {"\xE2\x80\x93", "a dash", "write - in its place"},
}};

constexpr std::string_view save_as_utf8 = "save the file as UTF-8 (Notepad: Save as, Encoding: UTF-8)";

/// Fault of a text in UTF-16, with a null byte beside every letter.
std::optional<Fault> utf_16(std::string_view text) {
  const bool marked = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const bool brace = text.starts_with(std::string_view("{\0", 2)) || text.starts_with(std::string_view("\0{", 2));
  if (!marked && !brace) return std::nullopt;
  return Fault{"", "is in the encoding UTF-16", std::string(save_as_utf8)};
}

/// Fault of a workbook, or of a table: two lines with separators and no JSON beginning.
std::optional<Fault> spreadsheet(std::string_view bytes, const std::filesystem::path& file) {
  const std::string rows = " makes a study of each of its rows";
  if (bytes.starts_with("PK")) return Fault{"", "is a workbook", "pastefit new --from TABLE.xlsx" + rows};
  const std::string text = trimmed(text_in_utf8(bytes).value_or(""));
  const std::size_t end = text.find('\n');
  if (end == text.npos || text.find_first_of("{[/") == 0 || text.find("\":") < end) return std::nullopt;
  const std::string row = text.substr(end + 1, text.find('\n', end + 1) - end);
  for (const char separator : {'\t', ';', ','})
    if (text.find(separator) < end && row.find(separator) != row.npos)
      return Fault{"", "is a table", "pastefit new --from " + shell_word_if_needed(file.string()) + rows};
  return std::nullopt;
}

/// Explanation of a parser error after `bytes_read` bytes; nothing if the parser's message is better.
std::optional<std::pair<std::string, std::string>> typed_there(std::string_view text, std::size_t bytes_read) {
  const std::size_t last = std::min(bytes_read, text.size());
  for (std::size_t at = last - std::min<std::size_t>(last, 3); at < last; ++at)
    for (const auto& [bytes, what, remedy] : foreign_characters)
      if (text.substr(at).starts_with(bytes)) return std::pair(std::string(what), std::string(remedy));
  const auto is_digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
  std::size_t first = last;
  while (first > 0 && is_digit(first - 1)) --first;
  if (first > 1 && is_digit(first) && text[first - 1] == ',' && is_digit(first - 2)) {
    std::size_t whole = first - 1;
    while (whole > 0 && (is_digit(whole - 1) || text[whole - 1] == '-')) --whole;
    std::size_t end = first;
    while (is_digit(end)) ++end;
    const std::string before(text.substr(whole, first - 1 - whole)), after(text.substr(first, end - first));
    if (before.size() + after.size() < 20)
      return std::pair("a decimal comma", "write " + before + "." + after + ", with a decimal point");
  }
  return std::nullopt;
}

/// First pass: checks syntax and duplicate keys. (The document type silently keeps the last one.)
class SyntaxCheck final : public nlohmann::json_sax<json> {
 public:
  SyntaxCheck(std::string_view text, Faults& faults) : text_(text), faults_(faults) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.keys.insert(name).second)
      faults_.push_back({place(), "the key stands twice in one object", "keep the one that is meant"});
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
    const auto typed = typed_there(text_, position);
    const std::string what = typed ? typed->first : complaint(error);
    const bool encoding = !typed && what.find("UTF-8") != std::string::npos;
    faults_.push_back({line_and_column(text_, position), "not JSON: " + what,
                       typed      ? typed->second
                       : encoding ? "if letters such as ö stand there, " + std::string(save_as_utf8)
                                  : "correct the text there"});
    return false;
  }

 private:
  struct Level {
    bool array = false;
    std::size_t elements = 0;
    std::string key;
    std::set<std::string> keys;
  };

  bool value() {
    if (!levels_.empty()) ++levels_.back().elements;
    return true;
  }

  bool open(bool array) {
    value();
    if (levels_.size() == deepest_nesting) {
      faults_.push_back({place(), "nested deeper than " + std::to_string(deepest_nesting) + " levels",
                         "no file of pastefit needs that: check the brackets"});
      return false;
    }
    levels_.push_back({array, 0, {}, {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string place() const {
    std::string path;
    for (const Level& level : levels_)
      path = level.array ? path + "[" + std::to_string(level.elements - (level.elements > 0)) + "]"
                         : joined(path, printable(level.key));
    return path;
  }

  std::string_view text_;
  Faults& faults_;
  std::vector<Level> levels_;
};

}  // namespace

std::optional<json> parse_json(std::string_view text, Faults& faults) {
  if (std::optional<Fault> foreign = utf_16(text)) {
    faults.push_back(std::move(*foreign));
    return std::nullopt;
  }
  // The parser treats a null byte as the end.
  if (const auto null = text.find('\0'); null != std::string_view::npos) {
    faults.push_back({line_and_column(text, null + 1), "not JSON: a null byte", "correct the text there"});
    return std::nullopt;
  }
  SyntaxCheck check(text, faults);
  if (!json::sax_parse(text.begin(), text.end(), &check, json::input_format_t::json, true, true)) return std::nullopt;
  return json::parse(text.begin(), text.end(), nullptr, false, true);
}

std::optional<json> read_json(const std::filesystem::path& file, Faults& faults) {
  const auto text = value_or_append(read_input(file, {.remedy = "give a file of pastefit", .ending = ".json"}), faults);
  if (!text) return std::nullopt;
  Faults found;
  std::optional<json> document = parse_json(text.value(), found);
  if (!document)
    if (std::optional<Fault> other = spreadsheet(text.value(), file)) found = {std::move(*other)};
  append(faults, in_file(std::move(found), file));
  return document;
}

bool has_format(const json& document, std::string_view expected, Faults& faults) {
  const std::string remedy = "write \"format\": " + in_quotes(expected);
  if (!document.is_object()) {
    faults.push_back({"", "the file holds " + text_of(document), "an object { ... } with " + remedy});
    return false;
  }
  const auto format = document.find("format");
  if (format == document.end()) {
    faults.push_back({"format", "is missing", remedy});
    return true;
  }
  if (format->is_string() && format->get_ref<const std::string&>() == expected) return true;
  const bool lab_for_study = format->is_string() &&
                             format->get_ref<const std::string&>().starts_with("pastefit-lab-") &&
                             expected.starts_with("pastefit-study-");
  faults.push_back({"format", "is " + text_of(*format),
                    lab_for_study ? "give the study of this laboratory file: pastefit new writes both"
                                  : remedy + ", or give the file that is meant"});
  return !(format->is_string() && format->get_ref<const std::string&>().starts_with("pastefit-"));
}

std::string text_of(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  if (value.is_null()) return "null";
  if (value.is_string()) return "the text " + in_quotes(value.get_ref<const std::string&>());
  return value.dump();
}

}  // namespace pastefit
