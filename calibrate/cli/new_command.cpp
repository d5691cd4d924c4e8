#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <span>
#include <system_error>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/options.h"
#include "calibrate/cli/sheet_file.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/cli/understood.h"
#include "calibrate/study/slump_sheet.h"

namespace pastefit {

namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string folder = ".";
  std::string test = "slump";
  std::string table;  ///< file with several sheets
  Sheet sheet;
  std::vector<std::string> readings, deviations, fixed, priors;  ///< "NAME=VALUES"
  bool force = false;
};

/// Asks a question on the terminal, again until `faults_of` is empty. Nothing at the end of the input.
std::optional<std::string> answer_to(const std::string& question, const std::string& suggestion,
                                     const std::function<Faults(const std::string&)>& faults_of) {
  while (true) {
    print("%s%s: ", question.c_str(), suggestion.empty() ? "" : (" [" + suggestion + "]").c_str());
    std::fflush(stdout);
    std::string answer;
    if (!std::getline(std::cin, answer)) return std::nullopt;
    if (answer.empty()) answer = suggestion;
    const Faults faults = faults_of(answer);
    if (faults.empty()) return answer;
    for (const Fault& fault : faults) print("  %s; %s\n", fault.what.c_str(), fault.remedy.c_str());
  }
}

template <class T>
Faults faults_in(const Result<T>& read) {
  return read.ok() ? Faults{} : read.faults();
}

/// For people.
std::string unit_in_words(const ShortReading& reading) {
  return reading.name == "mass" ? "kg" : reading.key.ends_with("_deg") ? "degrees" : "mm";
}

/// Asks for each reading by its short name; an empty answer omits it.
bool ask_readings(Sheet& sheet, const SlumpTest& test) {
  const std::optional<DropPlate>& plate = test.drop;
  for (const ShortReading& one : short_readings()) {
    const bool after_drop = one.key.starts_with("step2."), after_all = one.key.starts_with("after_drops.");
    const bool once = plate && plate->drops == 1, often = plate && plate->drops > 1;
    if ((after_drop && !once) || (after_all && !often)) continue;
    if (one.name == "shift" || one.name == "mass" || one.name == "slump2" || one.name == "slide-angle") continue;
    if (one.name == "angle" && !test.reading.flank) continue;
    if (one.name == "height" && !sheet.readings.empty()) continue;  // a slump gives the height
    const auto answer = answer_to(
        std::string(one.name) + ", " + std::string(one.meaning) + " (" + unit_in_words(one) +
            "; repeats as \"180, 175, 190\"; empty: not measured)",
        "", [&](const std::string& text) {
          return text.empty() ? Faults{}
                              : faults_in(written_readings("", text, one.key.ends_with("_deg") ? "deg" : "mm"));
        });
    if (!answer) return false;
    if (!answer->empty()) sheet.readings.emplace_back(one.name, *answer);
  }
  return true;
}

/// Asks for everything that the options do not give. False at the end of the input.
bool ask_sheet(Sheet& sheet, const fs::path& folder) {
  const auto ask = [](std::string& target, const std::string& question, const std::string& suggestion,
                      const auto& faults_of) {
    if (!target.empty()) return true;
    const auto answer = answer_to(question, suggestion, faults_of);
    if (answer) target = *answer;
    return answer.has_value();
  };
  if (!ask(sheet.mould,
           "mould: abrams, abrams-en, hinged-plate, haegermann-table, astm-c1437, haegermann, mini-cone, "
           "lifted-cylinder, "
           "or base/top/height in mm",
           "abrams", [&](const std::string& text) { return faults_in(apparatus_of(text, folder)); }) ||
      !ask(sheet.density, "density of the fresh material (kg/m3, or with its unit: 145 lb/ft3)", "",
           [](const std::string& text) { return faults_in(written_readings("", text, "kg_m3")); }))
    return false;
  const auto test = apparatus_of(sheet.mould, folder);
  if (sheet.readings.empty() && sheet.yield_stress.empty() && test.ok())
    if (!ask_readings(sheet, std::get<SlumpTest>(test.value()))) return false;
  return ask(sheet.target, "program that the material is for: " + names_of_targets(), "lammps", [](const auto& text) {
    return laws_for(text) ? Faults{} : Faults{{"", "is no such program", "one of " + names_of_targets()}};
  });
}

/// Missing options, for use without a terminal.
Faults missing_options(const Sheet& sheet) {
  Faults faults;
  if (sheet.mould.empty()) faults.push_back({"--mould", "is missing", "e.g. abrams, haegermann or 200/100/300"});
  if (sheet.density.empty())
    faults.push_back({"--density", "is missing", "e.g. 2350, or with its unit: \"145 lb/ft3\""});
  if (sheet.readings.empty() && sheet.yield_stress.empty())
    faults.push_back(
        {"--slump", "is missing, and so is every other reading", "e.g. --slump \"180, 175, 190\" --spread 330"});
  return faults;
}

/// Starting files of other kinds of tests: their templates.
StartingFiles templates_of_kind(const std::string& kind) {
  const auto lab = template_text(kind + "-lab"), study = template_text(kind + "-study");
  if (!lab || !study) refuse({no_such_kind("--test", kind)});
  return StartingFiles{*lab, *study};
}

/// Splits option texts "NAME=VALUES".
void part(const std::string& option, const std::vector<std::string>& texts, Sheet::Named& into, Faults& faults) {
  for (const std::string& text : texts) {
    const auto sign = text.find('=');
    const std::string name = text.substr(0, std::min(sign, text.size()));
    if (sign == std::string::npos || sign == 0)
      faults.push_back({option + " " + printable(text), "is not NAME=VALUE", "see pastefit new --help"});
    else if (option != "--reading" && std::ranges::count(into, name, &std::pair<std::string, std::string>::first) > 0)
      faults.push_back({option + " " + printable(name), "is given twice", "once"});
    else
      into.emplace_back(text.substr(0, sign), text.substr(sign + 1));
  }
}

void read_options(NewOptions& options) {
  Faults faults;
  Sheet& sheet = options.sheet;
  part("--reading", options.readings, sheet.readings, faults);
  part("--sd", options.deviations, sheet.deviations, faults);
  part("--fix", options.fixed, sheet.fixed, faults);
  part("--prior", options.priors, sheet.priors, faults);
  refuse(std::move(faults));
}

/// Files of one sheet and their target folder.
struct Start {
  fs::path folder;
  StartingFiles files;

  std::string in_folder(const char* name) const {
    return shell_word_if_needed(folder == "." ? name : (folder / name).string());
  }
};

void write_files(const std::vector<Start>& starts, bool force) {
  std::error_code error;
  Faults faults;
  for (const Start& start : starts) {
    append(faults, output_folder_faults(start.folder.string(), start.folder));
    for (const fs::path& file : {start.folder / "lab.json", start.folder / "study.json"})
      if (!force && fs::exists(file, error)) append(faults, output_file_faults(file.string(), file, force));
  }
  refuse(std::exchange(faults, {}));
  for (const Start& start : starts) fs::create_directories(start.folder, error);
  for (const Start& start : starts)
    for (const fs::path& file : {start.folder / "lab.json", start.folder / "study.json"})
      append(faults, output_file_faults(file.string(), file, force));
  refuse(std::move(faults));
  for (const Start& start : starts) {
    refuse(write_atomically(start.folder / "lab.json", start.files.lab));
    refuse(write_atomically(start.folder / "study.json", start.files.study));
    print("wrote %s\nwrote %s\n", (start.folder / "lab.json").c_str(), (start.folder / "study.json").c_str());
  }
}

/// Writes both files, and prints what was understood and the next steps.
int write_one(const NewOptions& options, const Start& start) {
  write_files({start}, options.force);
  if (const auto read = read_study(start.folder / "study.json"); read.ok())
    print("\n%s%s", understood(read.value()).c_str(), notes_on_readings(read.value()).c_str());
  print("\nNext:\n  pastefit calibrate %s --out %s\n", start.in_folder("study.json").c_str(),
        start.in_folder("out").c_str());
  if (const auto laws = laws_for(options.sheet.target, options.sheet.law); laws && options.test == "slump")
    print("  pastefit export %s --to %s --out %s\n", start.in_folder("out/card.json").c_str(),
          std::string(laws->export_target).c_str(), start.in_folder(std::string(laws->target).c_str()).c_str());
  return kDone;
}

std::string listed_briefly(const std::vector<std::string>& words) {
  constexpr std::size_t most = 20;
  const std::string list = listed(std::span(words).first(std::min(most, words.size())));
  return words.size() > most ? list + " and " + std::to_string(words.size() - most) + " more" : list;
}

std::vector<std::string> numbers_of(const std::vector<std::size_t>& lines) {
  std::vector<std::string> words;
  for (const std::size_t line : lines) words.push_back(std::to_string(line));
  return words;
}

/// Merges equal faults in the rows of a table, with the lines of each.
Faults in_lines(const std::vector<std::pair<std::size_t, Fault>>& found) {
  Faults faults;
  std::vector<std::vector<std::string>> lines;
  for (const auto& one : found) {
    const Fault& fault = one.second;
    const auto same = std::ranges::find_if(faults, [&](const Fault& other) {
      return other.where == fault.where && other.what == fault.what && other.remedy == fault.remedy;
    });
    const auto at = static_cast<std::size_t>(same - faults.begin());
    if (same == faults.end()) {
      faults.push_back(fault);
      lines.emplace_back();
    }
    lines[at].push_back(std::to_string(one.first));
  }
  for (std::size_t i = 0; i < faults.size(); ++i)
    faults[i].where = (lines[i].size() == 1 ? "line " : "lines ") + listed_briefly(lines[i]) + ": " + faults[i].where;
  return faults;
}

/// Writes a study for each row of a table; a single row is treated like a typed sheet.
int new_from_table(const NewOptions& options) {
  Faults of_table;
  const auto [rows, mix, unused, without, statistics] = read_sheet_table(options.table, options.sheet, of_table);
  std::vector<Start> starts;
  std::vector<std::pair<std::size_t, Fault>> found;
  for (const SheetRow& row : rows) {
    Start start{rows.size() == 1 ? fs::path(options.folder) : fs::path(options.folder) / row.name, {}};
    const Faults missing = missing_options(row.sheet);
    auto files = missing.empty() ? starting_files(row.sheet, start.folder) : missing;
    for (const Fault& fault : faults_in(files)) found.emplace_back(row.line, fault);
    if (files.ok()) start.files = std::move(files).value();
    starts.push_back(std::move(start));
  }
  append(of_table, in_file(in_lines(found), options.table));
  const auto said = [](const char* what, const std::vector<std::string>& words) {
    if (!words.empty()) note("%s: %s\n", what, one_line(listed_briefly(words)).c_str());
  };
  said("columns of the mix", mix);
  said("columns ignored", unused);
  said("lines without a reading", numbers_of(without));
  said("lines ignored because they are statistics", numbers_of(statistics));
  refuse(of_table);
  if (starts.size() == 1) return write_one(options, starts[0]);
  write_files(starts, options.force);
  for (const Start& start : starts)
    if (const auto read = read_study(start.folder / "study.json"); read.ok())
      if (const std::string notes = notes_on_readings(read.value()); !notes.empty())
        print("\n%s:\n%s", start.folder.c_str(), notes.c_str());
  const std::string folder = options.folder == "." ? "" : shell_word_if_needed(options.folder) + "/";
  print("\nNext:\n  pastefit batch %s*/study.json --out %sout\n", folder.c_str(), folder.c_str());
  return kDone;
}

int make_new(NewOptions options) {
  read_options(options);
  if (options.test != "slump" && !options.table.empty())
    refuse({{"--from", "is for slump tests only, but --test " + in_quotes(options.test) + " is not one",
             "leave one of them out"}});
  if (options.test != "slump") return write_one(options, {options.folder, templates_of_kind(options.test)});
  Sheet& sheet = options.sheet;
  if (options.table.empty() && !missing_options(sheet).empty() && isatty(STDIN_FILENO) == 1) {
    if (!ask_sheet(sheet, options.folder)) refuse({{"standard input", "ended before every answer", "start again"}});
    print("\n");
  }
  if (sheet.target.empty()) sheet.target = target_laws().front().target;
  if (!options.table.empty()) return new_from_table(options);
  refuse(missing_options(sheet));
  return write_one(options, {options.folder, value_or_throw(starting_files(sheet, options.folder))});
}

}  // namespace

Command add_new(CLI::App& verb) {
  const auto options = std::make_shared<NewOptions>();
  Sheet& sheet = options->sheet;
  sheet.target.clear();
  verb.add_option("DIR", options->folder, "folder for lab.json and study.json (.)");
  verb.add_option("--test", options->test, "slump; drop, pellet and shear write commented starting files")
      ->type_name("KIND");
  verb.add_option("--from", options->table,
                  "table of samples, as CSV or .xlsx: one row per sample below a header row such as \"sample;density "
                  "(kg/m3);slump (mm)\"; options supply what has no column")
      ->type_name("TABLE");
  verb.add_option("--title", sheet.title, "title of both files, one line")->type_name("TEXT");
  verb.add_option("--mould", sheet.mould,
                  "a preset (abrams, haegermann, ...), a standard (EN 12350-2), or base/top/height: \"200/100/300\", "
                  "\"8/4/12 in\"")
      ->type_name("MOULD");
  verb.add_option("--drops", sheet.drops,
                  "drops of the preset's plate or table, e.g. 15 with hinged-plate; default: the preset's")
      ->check(whole_number(1, 1000))
      ->type_name("N");
  verb.add_option("--density", sheet.density, "fresh density, in kg/m3 or with its unit: \"145 lb/ft3\"")
      ->type_name("DENSITY");
  for (const ShortReading& one : short_readings())
    verb.add_option_function<std::string>(
            "--" + std::string(one.name),
            [&sheet, &one](const std::string& text) {
              if (!text.empty()) sheet.readings.emplace_back(one.name, text);
            },
            std::string(one.meaning) + ": repeats as \"180, 175, 190\", in " + unit_in_words(one) +
                " or with their unit")
        ->type_name("VALUES");
  verb.add_option("--reading", options->readings, "any other reading of a laboratory file; repeatable")
      ->type_name("NAME=VALUES")
      ->take_all();
  verb.add_option("--sd", options->deviations,
                  "standard deviation of a reading between tests, in its unit: slump=10; default: the published one")
      ->type_name("NAME=VALUE")
      ->take_all();
  verb.add_option(
          "--grains", sheet.grains,
          "radius of the simulated grains, in mm or with its unit: \"8\", or a range \"6, 10\"; default: by mould")
      ->type_name("RADII");
  verb.add_option("--yield-stress", sheet.yield_stress,
                  "yield stress from a vane or another rheometer, in Pa or with its unit; it is compared; without any "
                  "reading, the reading that a formula predicts from it is fitted")
      ->type_name("VALUES");
  verb.add_option("--for", sheet.target, "program that the material is for: " + names_of_targets())
      ->type_name("PROGRAM");
  verb.add_option("--law", sheet.law, "law of attraction, instead of the default of the program: " + names_of_laws())
      ->type_name("LAW");
  verb.add_option("--fix", options->fixed, "fixes a known parameter: friction=0.2")
      ->type_name("NAME=VALUE")
      ->take_all();
  verb.add_option("--prior", options->priors,
                  "prior of a parameter, its value and standard deviation: friction=0.2+-0.05")
      ->type_name("NAME=VALUE+-SD")
      ->take_all();
  verb.add_option("--confirm", sheet.confirmed,
                  "key whose value looks like a mistake but is correct, as the error names it")
      ->type_name("PLACE")
      ->take_all();
  verb.add_flag("--force", options->force, "replace the files in DIR");
  return [options] { return make_new(*options); };
}

}  // namespace pastefit
