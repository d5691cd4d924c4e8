#include "calibrate/cli/sheet_file.h"

#include <minizip/unzip.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "calibrate/base/input_file.h"
#include "calibrate/base/text.h"

namespace pastefit {
namespace {

using Archive = std::unique_ptr<std::remove_pointer_t<unzFile>, decltype(&unzClose)>;

/// Name without its namespace prefix, which some programs write ("x:row").
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::vector<pugi::xml_node> children(const pugi::xml_node& node, std::string_view name) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xml_node& child : node.children())
    if (local_name(child) == name) found.push_back(child);
  return found;
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const pugi::xml_node& one) { return local_name(one) == name; });
}

/// XML part of a workbook. False if it is missing, damaged, or too large.
bool read_part(const Archive& archive, const std::string& name, pugi::xml_document& document) {
  constexpr std::size_t largest = std::size_t{64} << 20;
  unz_file_info64 info;
  const int any_case = 2;
  if (unzLocateFile(archive.get(), name.c_str(), any_case) != UNZ_OK ||
      unzGetCurrentFileInfo64(archive.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK ||
      info.uncompressed_size > largest || unzOpenCurrentFile(archive.get()) != UNZ_OK)
    return false;
  std::string text(info.uncompressed_size, '\0');
  const int count = unzReadCurrentFile(archive.get(), text.data(), static_cast<unsigned>(text.size()));
  return unzCloseCurrentFile(archive.get()) == UNZ_OK && count == static_cast<int>(text.size()) &&
         document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_ws_pcdata);
}

/// Path of the first sheet that is not hidden, by its relation in the workbook.
std::optional<std::string> first_sheet(const Archive& archive) {
  pugi::xml_document workbook, relations;
  if (!read_part(archive, "xl/workbook.xml", workbook) || !read_part(archive, "xl/_rels/workbook.xml.rels", relations))
    return std::nullopt;
  for (const pugi::xml_node& sheet : children(child(workbook.document_element(), "sheets"), "sheet")) {
    const std::string_view state = sheet.attribute("state").value();
    if (state == "hidden" || state == "veryHidden") continue;
    for (const pugi::xml_attribute& id : sheet.attributes()) {
      if (!std::string_view(id.name()).ends_with(":id")) continue;
      const auto relation = relations.document_element().find_child_by_attribute("Id", id.value());
      const std::string target = relation.attribute("Target").value();
      if (!target.empty()) return target.front() == '/' ? target.substr(1) : "xl/" + target;
    }
  }
  return std::nullopt;
}

/// Text of a string item: plain, or in runs of different fonts, without phonetic hints.
std::string text_of_item(const pugi::xml_node& item) {
  std::string text = child(item, "t").text().get();
  for (const pugi::xml_node& run : children(item, "r")) text += child(run, "t").text().get();
  return text;
}

/// Text of a cell; numbers with at most 15 digits, as spreadsheets show them.
std::string cell_text(const pugi::xml_node& cell, const std::vector<std::string>& strings) {
  const std::string_view type = cell.attribute("t").value();
  if (type == "inlineStr") return text_of_item(child(cell, "is"));
  const pugi::xml_text value = child(cell, "v").text();
  if (type == "s") return value.as_ullong() < strings.size() ? strings[value.as_ullong()] : "";
  if ((!type.empty() && type != "n") || value.empty()) return value.get();
  return format("%.15g", value.as_double());
}

/// Column of a cell such as "B12", from 0; `next` if the cell does not name it.
std::size_t column_of_cell(std::string_view place, std::size_t next) {
  std::size_t column = 0;
  for (const char letter : place.substr(0, 3))
    if (std::isupper(static_cast<unsigned char>(letter)))
      column = 26 * column + static_cast<std::size_t>(letter - 'A') + 1;
  return column == 0 ? next : column - 1;
}

/// Rows of a sheet as lines of quoted cells between tabs (RFC 4180); line N is row N.
std::string lines_of_sheet(const pugi::xml_node& data, const std::vector<std::string>& strings) {
  constexpr unsigned most_rows = 1048576;
  std::string text;
  unsigned line = 1;
  for (const pugi::xml_node& row : children(data, "row")) {
    for (const unsigned number = row.attribute("r").as_uint(line); line < std::min(number, most_rows); ++line)
      text += "\n";
    std::size_t at = 0, next = 0;
    for (const pugi::xml_node& cell : children(row, "c")) {
      const std::size_t column = std::min(column_of_cell(cell.attribute("r").value(), next), most_columns);
      next = column + 1;
      for (; at < column; ++at) text += "\t";
      std::string words = cell_text(cell, strings);
      for (std::size_t i = 0; (i = words.find('"', i)) != std::string::npos; i += 2) words.insert(i, 1, '"');
      text += "\"" + words + "\"";
    }
    text += "\n";
    ++line;
  }
  return text;
}

/// First visible sheet of a workbook; nothing if it is no workbook.
std::optional<std::string> text_of_workbook(const std::filesystem::path& file) {
  const Archive archive(unzOpen64(file.c_str()), &unzClose);
  const auto place = archive ? first_sheet(archive) : std::nullopt;
  pugi::xml_document sheet, shared;
  if (!place || !read_part(archive, *place, sheet)) return std::nullopt;
  std::vector<std::string> strings;
  if (read_part(archive, "xl/sharedStrings.xml", shared))
    for (const pugi::xml_node& item : children(shared.document_element(), "si")) strings.push_back(text_of_item(item));
  return lines_of_sheet(child(sheet.document_element(), "sheetData"), strings);
}

}  // namespace

SheetTable read_sheet_table(const std::filesystem::path& file, const Sheet& defaults, Faults& faults) {
  const auto bytes =
      value_or_append(read_input(file, {.remedy = "a table, saved as CSV or .xlsx", .ending = ".csv"}), faults);
  if (!bytes) return {};
  const std::string_view start = bytes.value();
  const bool archive = start.starts_with("PK"), old_workbook = start.starts_with("\xD0\xCF\x11\xE0");
  const auto text = archive ? text_of_workbook(file) : std::optional(bytes.value());
  if (!text || old_workbook) {
    faults.push_back({printable(file.string()),
                      old_workbook ? "is an old or encrypted workbook" : "is no workbook that can be read",
                      "save it as .xlsx without a password, or its sheet as CSV: in Excel Save As, \"CSV UTF-8\"; in "
                      "LibreOffice Save As, \"Text CSV\""});
    return {};
  }
  Faults found;
  SheetTable table = sheet_table(*text, defaults, found);
  append(faults, in_file(std::move(found), file));
  for (SheetRow& row : table.rows) row.sheet.source = file.filename().string() + ", line " + std::to_string(row.line);
  return table;
}

}  // namespace pastefit
