#include "calibrate/study/sheet_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <span>
#include <utility>

#include "calibrate/base/input_file.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/study/written_readings.h"

namespace pastefit {
namespace {

/// What a head is in `pastefit new`, and how it may say it, as `folded` makes it. Sources of the names: EN 12350-2, -5
/// and -6, EN 1015-3 and ASTM C143, C138 and C1437, and the German editions of the first.
struct Heading {
  std::string_view is, says;
};

constexpr std::string_view kSample = "sample", kTitle = "title", kMould = "mould", kDensity = "density",
                           kDrops = "drops", kYieldStress = "yield-stress";

constexpr std::array<Heading, 15> headings{{
    {kSample, "|sample|mix|mixture|specimen|id|no|name|probe|mischung|rezeptur|"},
    {kTitle, "|title|description|bezeichnung|"},
    {kMould, "|mould|mold|cone|form|"},
    {kDensity, "|density|bulk density|fresh density|unit weight|dichte|rohdichte|frischbetonrohdichte|"},
    {kDrops, "|drops|strokes|stoesse|hubstoesse|"},
    {kYieldStress, "|yield stress|fliessgrenze|"},
    {"slump", "|setzmass|"},
    {"height", "|hoehe|h1|"},
    {"height2", "|h2|"},
    {"spread", "|slump flow|setzfliessmass|breite|"},
    {"flow", "|ausbreitmass|"},
    {"mass", "|masse|"},
    {"angle", "|angle of repose|schuettwinkel|"},
    {"step1.t500_s", "|t500|"},
    {"height-after", "|height after|"},
}};

constexpr std::size_t most_samples = 1000, most_columns = 300,
                      longest_cell = 500;  // std::regex recurses with the length

/// In small letters without umlauts, with a blank for what is no letter and no digit.
std::string folded(std::string_view text) {
  static const std::map<std::string_view, std::string_view> letters{{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"Ä", "ae"},
                                                                    {"Ö", "oe"}, {"Ü", "ue"}, {"ß", "ss"}};
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char letter = static_cast<unsigned char>(text[i]);
    if (const auto found = letters.find(text.substr(i, 2)); found != letters.end()) {
      out += found->second;
      ++i;
    } else if (std::isalnum(letter)) {
      out += static_cast<char>(std::tolower(letter));
    } else if (!out.empty() && out.back() != ' ') {
      out += ' ';
    }
  }
  return trimmed(out);
}

/// A column of the table: what it is in `pastefit new`, or a variable of the mix; neither of one that is not used.
struct SheetColumn {
  std::string head, says;
  std::string is, mix;
  std::string unit;  ///< as the head has it
  bool known() const { return !is.empty() || !mix.empty(); }
};

/// Parts a head into what it says and its unit: "Slump 1 (mm)", "slump, in", "slump_mm", "Slump in mm".
std::pair<std::string, std::string> parted(const std::string& head) {
  std::smatch found;
  static const std::regex in_brackets(R"(^(.*?)[(\[]([^)\]]*)[)\]](.*)$)");
  if (std::regex_match(head, found, in_brackets))
    return {found[1].str() + " " + found[3].str(), with_percent_sign(trimmed(found[2].str()))};
  std::string unit;
  std::size_t end = std::string::npos;
  for (std::size_t i = head.size(); i-- > 1;) {
    if (head[i] != ' ' && head[i] != ',' && head[i] != '_') continue;
    if (unit_of_word(trimmed(head.substr(i + 1)))) unit = trimmed(head.substr(i + 1)), end = i;
  }
  std::string says = head.substr(0, end);
  if (!unit.empty() && says.ends_with(" in")) says.resize(says.size() - 3);
  return {says, unit};
}

std::string without_number(const std::string& says) {
  const std::size_t last = says.find_last_not_of("0123456789");
  return last == std::string::npos ? says : trimmed(says.substr(0, last + 1));
}

/// What a head is in `pastefit new`: by its whole name, else without the number of a repeat. Empty if it is nothing.
std::string meaning_of(const std::string& head, const std::string& says) {
  for (const std::string& name : {says, without_number(says)}) {
    const auto heading = std::ranges::find_if(
        headings, [&](const Heading& one) { return one.says.find("|" + name + "|") != std::string_view::npos; });
    if (heading != headings.end()) return std::string(heading->is);
    for (const ShortReading& one : short_readings())
      if (folded(one.name) == name || one.key == head) return std::string(one.name);
  }
  return "";
}

/// "slump2" is a reading after the drop, unless a "slump1" stands beside it.
void take_numbers_for_repeats(std::vector<SheetColumn>& columns) {
  for (SheetColumn& column : columns) {
    const std::string bare = without_number(column.says);
    const bool first = std::ranges::any_of(
        columns, [&](const SheetColumn& other) { return other.says == bare + "1" || other.says == bare + " 1"; });
    if (first && bare != column.says && bare != "h" && !meaning_of("", bare).empty()) column.is = meaning_of("", bare);
  }
}

std::vector<SheetColumn> columns_of(const CsvLine& line) {
  std::vector<SheetColumn> columns;
  for (const std::string& cell : std::span(line.cells).first(std::min(line.cells.size(), most_columns))) {
    const std::string head = cell.size() > longest_cell ? std::string() : cell;
    SheetColumn column{.head = head, .says = {}, .is = {}, .mix = {}, .unit = {}};
    const auto [says, unit] = parted(head);
    column.says = folded(says);
    column.unit = unit;
    column.is = meaning_of(head, column.says);
    const auto known = unit_of_word(unit);
    if (column.is.empty() && known && known->key == "kg_m3" && !column.says.empty() && column.says[0] >= 'a') {
      column.mix = (column.says.starts_with("mix ") ? column.says.substr(4) : column.says) + "_kg_m3";
      std::ranges::replace(column.mix, ' ', '_');
    }
    columns.push_back(std::move(column));
  }
  take_numbers_for_repeats(columns);
  return columns;
}

bool is_of_sample(const std::string& is) {
  return is == kSample || is == kTitle || is == kMould || is == kDensity || is == kDrops;
}

bool names_reading(const std::vector<SheetColumn>& columns) {
  return std::ranges::any_of(columns, [](const SheetColumn& one) { return !one.is.empty() && !is_of_sample(one.is); });
}

/// The table with the separator and the line that make the most of its head.
struct Layout {
  std::vector<CsvLine> lines;
  std::vector<SheetColumn> columns;
  std::size_t first = 0;  ///< line below the head
  bool decimal_comma = false;
};

std::optional<Layout> layout_of(std::string_view text) {
  constexpr std::size_t most_above = 20;
  std::optional<Layout> best;
  std::ptrdiff_t most = 0;
  for (const char separator : {'\t', ';', ','}) {
    const std::vector<CsvLine> lines = csv_lines(text, separator);
    for (std::size_t i = 0; i < std::min(lines.size(), most_above); ++i) {
      std::vector<SheetColumn> columns = columns_of(lines[i]);
      const auto known = std::ranges::count_if(columns, &SheetColumn::known);
      if (known <= most || !names_reading(columns)) continue;
      most = known;
      best = Layout{lines, std::move(columns), i + 1, separator != ','};
    }
  }
  return best;
}

std::string cell_of(const CsvLine& line, std::size_t column) {
  return column < line.cells.size() ? line.cells[column] : std::string();
}

bool is_missing(const std::string& cell) {
  static const std::set<std::string, std::less<>> words{"",    "-",    "–",  "—",   "/",  "n/a",
                                                        "N/A", "n.a.", "NA", "nan", "NaN"};
  return words.contains(cell);
}

/// Takes a line below the head that holds units only.
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
    if (is_missing(line.cells[i])) continue;
    if (!unit_of_word(unit_in(i))) return;
    any = true;
  }
  if (!any) return;
  for (std::size_t i = 0; i < layout.columns.size(); ++i)
    if (layout.columns[i].unit.empty()) layout.columns[i].unit = unit_in(i);
  ++layout.first;
}

/// Numbers with decimal points, where a comma between digits is a decimal one; a list without blanks stays as it is.
std::string with_points(const std::string& cell) {
  static const std::regex list(R"(\d,\d+,\d)"), comma(R"((\d),(\d))");
  return std::regex_search(cell, list) ? cell : std::regex_replace(cell, comma, "$1.$2");
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

/// Takes a cell for what its column is.
void take_cell(const SheetColumn& column, const std::string& cell, const std::string& where, SheetRow& row,
               Faults& faults) {
  Sheet& sheet = row.sheet;
  const std::string text = with_unit(cell, column.unit);
  if (!column.mix.empty()) {
    const auto number = written_number(text);
    if (number)
      sheet.mix.emplace_back(column.mix, number->value * (number->unit ? number->unit->factor : 1));
    else
      faults.push_back({where, "holds " + in_quotes(cell) + ", which is no number", "a number, or nothing"});
  } else if (column.is == kSample) {
    row.name = folder_name(cell);
    sheet.title = cell;
  } else if (column.is == kTitle) {
    sheet.title = cell;
  } else if (column.is == kMould) {
    sheet.mould = cell;
  } else if (column.is == kDensity) {
    sheet.density = text;
  } else if (column.is == kYieldStress) {
    sheet.yield_stress += (sheet.yield_stress.empty() ? "" : "; ") + text;
  } else if (column.is == kDrops) {
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

SheetRow row_from(const Layout& layout, const CsvLine& line, const Sheet& defaults, Faults& faults) {
  SheetRow row{.name = {}, .line = line.number, .sheet = defaults};
  row.sheet.readings.clear();
  row.sheet.yield_stress.clear();
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const SheetColumn& column = layout.columns[i];
    const std::string cell = cell_of(line, i);
    if (!column.known() || is_missing(cell)) continue;
    const std::string where = "line " + std::to_string(line.number) + ", " + in_quotes(column.head);
    const bool words = column.is == kSample || column.is == kTitle || column.is == kMould;
    if (cell.size() > longest_cell)
      faults.push_back({where, "has " + std::to_string(cell.size()) + " letters", "a number, or a word"});
    else
      take_cell(column, words || !layout.decimal_comma ? cell : with_points(cell), where, row, faults);
  }
  for (const auto& reading : defaults.readings)
    if (std::ranges::count(row.sheet.readings, reading.first, &std::pair<std::string, std::string>::first) == 0)
      row.sheet.readings.push_back(reading);
  if (row.name.empty()) row.name = "line-" + std::to_string(line.number);
  return row;
}

/// Heads that no reading and no number can have, and those that stand twice where one is right.
Faults faults_of_heads(const Layout& layout) {
  Faults faults;
  std::set<std::string> seen;
  for (const SheetColumn& column : layout.columns) {
    if (!column.known()) continue;
    const bool text = column.is == kSample || column.is == kTitle || column.is == kMould || column.is == kDrops;
    if (!text && !column.unit.empty() && column.unit != "%" && !unit_of_word(column.unit))
      faults.push_back({"head " + in_quotes(column.head),
                        "has the unit " + in_quotes(column.unit) + ", which is not known",
                        "e.g. mm, cm, in, kg/m3, Pa"});
    const bool once = is_of_sample(column.is) || !column.mix.empty();
    if (once && !seen.insert(column.is + column.mix).second)
      faults.push_back({"head " + in_quotes(column.head), "says what another column says", "one of both columns"});
  }
  return faults;
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
                      "a table with a head, e.g. \"sample;mould;density (kg/m3);slump (mm);spread (mm)\"; save a "
                      "workbook as CSV"});
    return table;
  }
  take_units(*layout);
  for (Fault& fault : faults_of_heads(*layout)) faults.push_back(std::move(fault));
  for (const SheetColumn& column : layout->columns)
    if (!column.known() && !column.head.empty()) table.unused.push_back(column.head);
  for (std::size_t i = layout->first; i < layout->lines.size() && table.rows.size() < most_samples; ++i) {
    const CsvLine& line = layout->lines[i];
    if (std::ranges::all_of(line.cells, is_missing)) continue;
    SheetRow row = row_from(*layout, line, defaults, faults);
    if (row.sheet.readings.empty() && row.sheet.yield_stress.empty())
      table.without.push_back(line.number);
    else
      table.rows.push_back(std::move(row));
  }
  if (layout->columns.size() == most_columns)
    faults.push_back({"", "has " + std::to_string(most_columns) + " columns or more", "the columns of a sheet alone"});
  if (table.rows.size() == most_samples)
    faults.push_back({"", "has " + std::to_string(most_samples) + " samples or more", "several tables"});
  for (Fault& fault : faults_of_names(table.rows)) faults.push_back(std::move(fault));
  if (table.rows.empty()) faults.push_back({"", "has no row with a reading", "a row a sample, below the head"});
  return table;
}

SheetTable read_sheet_table(const std::filesystem::path& file, const Sheet& defaults, Faults& faults) {
  const auto bytes = read_input(file, {.remedy = "a table, saved as CSV", .ending = ".csv"});
  if (!bytes.ok()) {
    faults.insert(faults.end(), bytes.faults().begin(), bytes.faults().end());
    return {};
  }
  if (bytes.value().starts_with("PK")) {
    faults.push_back({printable(file.string()), "is a workbook", "save its sheet as CSV, and give that file"});
    return {};
  }
  Faults found;
  SheetTable table = sheet_table(bytes.value(), defaults, found);
  for (Fault& fault : in_file(std::move(found), file)) faults.push_back(std::move(fault));
  for (SheetRow& row : table.rows) row.sheet.source = file.filename().string() + ", line " + std::to_string(row.line);
  return table;
}

}  // namespace pastefit
