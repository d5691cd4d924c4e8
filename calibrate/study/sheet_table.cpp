#include "calibrate/study/sheet_table.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <regex>
#include <utility>

#include "calibrate/base/input_file.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {
namespace {

constexpr std::size_t most_samples = 1000;

/// Table with the separator and header line that give most known columns.
struct Layout {
  std::vector<CsvLine> lines;
  std::vector<SheetColumn> columns;
  std::size_t first = 0;  ///< line below the header
  char separator = ',';
};

std::optional<Layout> layout_of(std::string_view text) {
  constexpr std::size_t most_above = 20;
  std::optional<Layout> best;
  std::ptrdiff_t most = 0;
  for (const char separator : {'\t', ';', ','}) {
    const std::vector<CsvLine> lines = csv_lines(text, separator);
    for (std::size_t i = 0; i < std::min(lines.size(), most_above); ++i) {
      std::vector<SheetColumn> columns = sheet_columns(lines[i]);
      const auto known = std::ranges::count_if(columns, &SheetColumn::known);
      if (known <= most || !names_reading(columns)) continue;
      most = known;
      best = Layout{lines, std::move(columns), i + 1, separator};
    }
  }
  return best;
}

std::string cell_of(const CsvLine& line, std::size_t column) {
  return column < line.cells.size() ? line.cells[column] : std::string();
}

/// True if the word is in a list "|one|two|".
bool is_one_of(std::string_view words, const std::string& word) {
  return words.find("|" + word + "|") != std::string_view::npos;
}

/// True for what people and Excel write in place of a missing value.
bool is_missing(const std::string& cell) {
  return is_one_of("||-|–|—|/|?|x|n/a|n.a.|na|nan|n.b.|k.a.|k. a.|#nv|#n/a|#div/0!|not measured|nicht gemessen|",
                   small_letters(cell));
}

/// True for rows of statistics below the samples.
bool is_of_statistics(const std::string& sample) {
  return is_one_of(
      "|mean|average|mittel|mittelwert|durchschnitt|median|stabw|standardabweichung|standard deviation|std|st "
      "dev|sd|min|max|minimum|maximum|sum|summe|n|anzahl|count|",
      folded(sample));
}

/// Reads units from the line below the header, if it contains only units.
void take_units(Layout& layout) {
  if (layout.first >= layout.lines.size()) return;
  const CsvLine& line = layout.lines[layout.first];
  const auto unit_in = [&](std::size_t i) {
    std::string cell = cell_of(line, i);
    std::erase_if(cell, [](char letter) { return letter == '(' || letter == ')' || letter == '[' || letter == ']'; });
    return cell;
  };
  bool any = false;
  for (std::size_t i = 0; i < line.cells.size(); ++i) {
    if (is_missing(line.cells[i]) || is_one_of("|unit|units|einheit|einheiten|%|", small_letters(unit_in(i)))) continue;
    if (!unit_of_word(unit_in(i))) return;
    any = true;
  }
  if (!any) return;
  for (std::size_t i = 0; i < layout.columns.size(); ++i)
    if (layout.columns[i].unit.empty()) layout.columns[i].take_unit(is_missing(cell_of(line, i)) ? "" : unit_in(i));
  ++layout.first;
}

/// Replaces decimal commas by points, except in what may be a list or contain thousands separators.
std::string with_points(const std::string& cell) {
  static const std::regex other(R"(\d,\d+,\d|\d\d,\d\d\d(?!\d)|\d\.\d+,\d)"), comma(R"((\d),(\d))");
  return std::regex_search(cell, other) ? cell : std::regex_replace(cell, comma, "$1.$2");
}

std::string with_unit(const std::string& cell, const std::string& unit) {
  const bool has_one = std::ranges::any_of(
      cell, [](unsigned char letter) { return std::isalpha(letter) || letter == '%' || letter == '"'; });
  return unit.empty() || has_one ? cell : cell + " " + unit;
}

std::string folder_name(const std::string& sample) {
  constexpr std::size_t longest = 60;
  std::string name = folded(sample).substr(0, longest);
  std::ranges::replace(name, ' ', '-');
  return name;
}

/// Stores a cell as its column's value.
void take_cell(const SheetColumn& column, const std::string& cell, const std::string& where, SheetRow& row,
               Faults& faults) {
  Sheet& sheet = row.sheet;
  const std::string text = with_unit(cell, column.unit);
  if (!column.mix.empty()) {
    static const std::regex thousands(R"(\d{1,3}([.,]\d{3})+)");
    const auto number = written_number(text);
    if (number && !number->comma && !std::regex_match(cell, thousands))
      sheet.mix.emplace_back(column.mix, number->value * (number->unit ? number->unit->factor : 1));
    else
      faults.push_back({where, "holds " + in_quotes(cell), "a number without a sign between thousands, or nothing"});
  } else if (column.is == kIsSample) {
    row.name = folder_name(cell);
    sheet.title = cell;
  } else if (column.is == kIsTitle) {
    sheet.title = cell;
  } else if (column.is == kIsMould) {
    sheet.mould = cell;
  } else if (column.is == kIsDensity) {
    sheet.density = text;
  } else if (column.is == kIsYieldStress) {
    sheet.yield_stress += (sheet.yield_stress.empty() ? "" : "; ") + text;
  } else if (column.is == kIsDrops) {
    const auto number = written_number(cell);
    if (number && !number->unit && number->value >= 1 && number->value <= 1000)
      sheet.drops = static_cast<int>(number->value);
    else
      faults.push_back({where, "holds " + in_quotes(cell), "how often the table drops, from 1 to 1000"});
  } else {
    const auto same = std::ranges::find(sheet.readings, column.is, &std::pair<std::string, std::string>::first);
    if (same == sheet.readings.end())
      sheet.readings.emplace_back(column.is, text);
    else
      same->second += "; " + text;
  }
}

/// Faults of a line with surplus cells, or with a quoted cell that spans several lines.
Faults misplaced_cells(const Layout& layout, const CsvLine& line) {
  Faults faults;
  const std::string where = "line " + std::to_string(line.number);
  for (const std::string& cell : line.cells)
    if (cell.find('\n') != std::string::npos && cell.find(layout.separator) != std::string::npos)
      faults.push_back({where, "has a quotation mark that closes in a later line, or nowhere", "close it in its cell"});
  for (std::size_t i = layout.columns.size(); i < line.cells.size() && faults.empty(); ++i)
    if (!is_missing(line.cells[i]))
      faults.push_back({where, "has more cells than the header row: " + in_quotes(line.cells[i]),
                        "give each column a header; decimal commas require semicolons or tabs between the cells"});
  return faults;
}

SheetRow row_from(const Layout& layout, const CsvLine& line, const Sheet& defaults, Faults& faults) {
  SheetRow row{.name = {}, .line = line.number, .sheet = defaults};
  row.sheet.readings.clear();
  row.sheet.yield_stress.clear();
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const SheetColumn& column = layout.columns[i];
    const std::string cell = cell_of(line, i);
    const bool words = column.is == kIsSample || column.is == kIsTitle || column.is == kIsMould;
    if (!column.known() || cell.empty() || (!words && is_missing(cell))) continue;
    const std::string where = "line " + std::to_string(line.number) + ", " + in_quotes(column.head);
    if (cell.size() > longest_cell)
      faults.push_back({where, "has " + std::to_string(cell.size()) + " letters", "a number, or a word"});
    else
      take_cell(column, words || layout.separator == ',' ? cell : with_points(cell), where, row, faults);
  }
  for (const auto& reading : defaults.readings)
    if (std::ranges::count(layout.columns, reading.first, &SheetColumn::is) == 0) row.sheet.readings.push_back(reading);
  if (row.name.empty()) row.sheet.title = "line " + std::to_string(line.number);
  if (row.name.empty()) row.name = folder_name(row.sheet.title);
  return row;
}

Faults faults_of_names(const std::vector<SheetRow>& rows) {
  Faults faults;
  std::map<std::string, std::size_t> lines;
  for (const SheetRow& row : rows) {
    const auto [first, is_new] = lines.emplace(row.name, row.line);
    if (!is_new)
      faults.push_back(
          {"line " + std::to_string(row.line),
           "has the sample " + in_quotes(row.sheet.title) + ", as line " + std::to_string(first->second) + " has",
           "another name; repeats stand in one row, as \"slump 1\", \"slump 2\" or as \"180; 175\""});
  }
  return faults;
}

}  // namespace

SheetTable sheet_table(std::string_view bytes, const Sheet& defaults, Faults& faults) {
  const auto text = text_in_utf8(bytes);
  std::optional<Layout> layout = text ? layout_of(*text) : std::nullopt;
  SheetTable table;
  if (!layout) {
    faults.push_back({"", "has no line that names a reading",
                      "give a table with a header row, e.g. \"sample;mould;density (kg/m3);slump (mm);spread (mm)\"; "
                      "a workbook needs it on its first sheet"});
    return table;
  }
  take_units(*layout);
  append(faults, faults_of_heads(layout->columns));
  for (const SheetColumn& column : layout->columns)
    if (!column.mix.empty())
      table.mix.push_back(column.head);
    else if (!column.known() && !column.head.empty())
      table.unused.push_back(column.head);
  for (std::size_t i = layout->first; i < layout->lines.size() && table.rows.size() < most_samples; ++i) {
    const CsvLine& line = layout->lines[i];
    if (std::ranges::all_of(line.cells, is_missing)) continue;
    append(faults, misplaced_cells(*layout, line));
    SheetRow row = row_from(*layout, line, defaults, faults);
    if (is_of_statistics(row.sheet.title))
      table.statistics.push_back(line.number);
    else if (row.sheet.readings.empty() && row.sheet.yield_stress.empty())
      table.without.push_back(line.number);
    else
      table.rows.push_back(std::move(row));
  }
  if (layout->columns.size() == most_columns)
    faults.push_back({"", "has " + std::to_string(most_columns) + " columns or more", "the columns of a sheet alone"});
  if (table.rows.size() == most_samples)
    faults.push_back({"", "has " + std::to_string(most_samples) + " samples or more", "several tables"});
  append(faults, faults_of_names(table.rows));
  if (table.rows.empty())
    faults.push_back({"", "has no row with a reading", "one row per sample below the header row"});
  return table;
}

}  // namespace pastefit
