#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/study/sheet_table.h"

namespace pastefit {
namespace {

/// Meaning of a heading in `pastefit new`, and its possible texts after `folded`. Sources: EN 12350-2, -5 and -6, EN
/// 1015-3, ASTM C143, C138 and C1437, and the German editions of the EN standards.
struct Heading {
  std::string_view is, says;
};

constexpr std::array<Heading, 16> headings{{
    {kIsSample,
     "|sample|sample id|sample no|mix|mix id|mix no|mixture|specimen|id|no|nr|name|batch|series|test|probe|probe "
     "nr|probennummer|mischung|mischung nr|rezeptur|charge|serie|lfd nr|"},
    {kIsTitle, "|title|description|bezeichnung|"},
    {kIsMould, "|mould|mold|cone|form|"},
    {kIsDensity,
     "|density|bulk density|fresh density|wet density|plastic density|concrete density|unit "
     "weight|dichte|rohdichte|rohdichte frisch|frischrohdichte|frischbetonrohdichte|"},
    {kIsDrops, "|drops|strokes|stoesse|hubstoesse|"},
    {kIsYieldStress, "|yield stress|fliessgrenze|"},
    {"slump", "|slump value|slump test|setzmass|"},
    {"height", "|hoehe|h1|"},
    {"height2", "|h2|"},
    {"spread", "|slump flow|spread diameter|diameter|setzfliessmass|setzfliessmass sf|breite|"},
    {"flow", "|flow value|flow diameter|ausbreitmass|"},
    {"mass", "|masse|"},
    {"angle", "|angle of repose|schuettwinkel|"},
    {"slide-angle", "|slide angle|sliding angle|angle of slide|rutschwinkel|gleitwinkel|"},
    {"step1.t500_s", "|t500|"},
    {"height-after", "|height after|"},
}};

/// Splits a heading into name and unit: "Slump 1 (mm)", "slump, in", "slump_mm", "Slump in mm".
std::pair<std::string, std::string> parted(const std::string& head) {
  std::smatch found;
  static const std::regex in_brackets(R"(^(.*?)[(\[]([^)\]]*)[)\]](.*)$)");
  if (std::regex_match(head, found, in_brackets))
    return {found[1].str() + " " + found[3].str(), with_percent_sign(trimmed(found[2].str()))};
  std::string unit;
  std::size_t end = std::string::npos;
  for (std::size_t i = head.size(); i-- > 1;) {
    if (head[i] != ' ' && head[i] != ',' && head[i] != '_' && head[i] != '/') continue;
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

/// Meaning of a heading in `pastefit new`, by its full name, else by its name without a repeat number; empty if
/// unknown.
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

/// Takes "slump2" for the reading after the drop, unless there is a "slump1", or a "slump 1" without a "slump 2".
void take_numbers_for_repeats(std::vector<SheetColumn>& columns) {
  const auto has = [&](const std::string& says) { return std::ranges::count(columns, says, &SheetColumn::says) > 0; };
  for (SheetColumn& column : columns) {
    const std::string bare = without_number(column.says), spaced = bare + " " + column.says.substr(bare.size());
    const bool first = has(bare + "1") || (has(bare + " 1") && !has(spaced));
    if (first && bare != column.says && bare != "h" && !meaning_of("", bare).empty()) column.is = meaning_of("", bare);
  }
}

bool is_of_sample(const std::string& is) {
  return is == kIsSample || is == kIsTitle || is == kIsMould || is == kIsDensity || is == kIsDrops;
}

/// Repeat number at the end of a name; 0 if there is none.
int number_of(const std::string& says) {
  const std::string digits = says.substr(std::min(says.size(), says.find_last_not_of("0123456789") + 1));
  return digits.empty() || digits.size() > 4 ? 0 : std::stoi(digits);
}

/// Checks the columns of one reading, which are its repeats: none numbered, all numbered from 1, or all but the first.
Faults faults_of_repeats(std::span<const SheetColumn> columns, const SheetColumn& last) {
  std::vector<int> numbers;
  for (const SheetColumn& one : columns) {
    if (one.is != last.is) continue;
    const bool own_name = !meaning_of("", one.says).empty() && meaning_of("", without_number(one.says)) != last.is;
    numbers.push_back(own_name ? 0 : number_of(one.says));
    if (one.unit != last.unit)
      return {{"head " + in_quotes(last.head),
               "has another unit than " + in_quotes(one.head) + ", which is the same reading",
               "one unit for all its columns, or one column"}};
  }
  std::ranges::sort(numbers);
  const std::string bare = without_number(last.says), second = meaning_of("", bare + "2");
  const bool from_one = numbers.front() == 1 || numbers.back() == 0;
  bool counted = true;
  for (std::size_t i = 0; i < numbers.size() && numbers.back() > 0; ++i)
    counted = counted && (numbers[i] == static_cast<int>(i) + 1 || (i == 0 && numbers[0] == 0));
  if (!from_one && numbers == std::vector{0, 2} && second != last.is)
    return {{"head " + in_quotes(last.head), "may be a repeat, or the reading after the drop",
             in_quotes(bare + " 1") + " and " + in_quotes(bare + " 2") + " for repeats, " + in_quotes(bare + "2") +
                 " after the drop"}};
  if (counted) return {};
  return {{"head " + in_quotes(last.head), "is of columns whose numbers do not count repeats",
           in_quotes(bare + " 1") + ", " + in_quotes(bare + " 2") + " and so on, without a mean"}};
}

}  // namespace

std::string folded(std::string_view text) {
  static const std::map<std::string_view, std::string_view> letters{{"ä", "ae"}, {"ö", "oe"},    {"ü", "ue"},
                                                                    {"Ä", "ae"}, {"Ö", "oe"},    {"Ü", "ue"},
                                                                    {"ß", "ss"}, {"Ø", " mean"}, {"ø", " mean"}};
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

void SheetColumn::take_unit(const std::string& word) {
  unit = word;
  const auto known_unit = unit_of_word(word);
  const bool density = says.find("density") != std::string::npos || says.find("dichte") != std::string::npos ||
                       says.find("unit weight") != std::string::npos;
  if (!is.empty() || !known_unit || known_unit->key != "kg_m3" || density || says.empty() || says[0] < 'a') return;
  mix = (says.starts_with("mix ") ? says.substr(4) : says) + "_kg_m3";
  std::ranges::replace(mix, ' ', '_');
}

std::vector<SheetColumn> sheet_columns(const CsvLine& line) {
  std::vector<SheetColumn> columns;
  for (const std::string& cell : std::span(line.cells).first(std::min(line.cells.size(), most_columns))) {
    const std::string head = cell.size() > longest_cell ? std::string() : cell;
    SheetColumn column{.head = head, .says = {}, .is = {}, .mix = {}, .unit = {}};
    const auto [says, unit] = parted(head);
    column.says = folded(says);
    column.is = meaning_of(head, column.says);
    column.take_unit(unit);
    columns.push_back(std::move(column));
  }
  take_numbers_for_repeats(columns);
  return columns;
}

bool names_reading(std::span<const SheetColumn> columns) {
  return std::ranges::any_of(columns, [](const SheetColumn& one) { return !one.is.empty() && !is_of_sample(one.is); });
}

Faults faults_of_heads(std::span<const SheetColumn> columns) {
  Faults faults;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const SheetColumn& column = columns[i];
    if (!column.known()) continue;
    const std::string where = "head " + in_quotes(column.head);
    const bool text = column.is == kIsSample || column.is == kIsTitle || column.is == kIsMould || column.is == kIsDrops;
    if (!text && !column.unit.empty() && column.unit != "%" && !unit_of_word(column.unit))
      faults.push_back(
          {where, "has the unit " + in_quotes(column.unit) + ", which is not known", "e.g. mm, cm, in, kg/m3, Pa"});
    const bool once = is_of_sample(column.is) || !column.mix.empty();
    if (once && !seen.insert(column.is + column.mix).second)
      faults.push_back({where, "says what another column says", "one of both columns"});
    const auto later = columns.subspan(i + 1);
    if (!once && std::ranges::count(later, column.is, &SheetColumn::is) == 0)
      append(faults, faults_of_repeats(columns, column));
  }
  return faults;
}

}  // namespace pastefit
