#include "tests/fuzz/readers.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/batch/batch.h"
#include "calibrate/card/card.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/impact_json.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/sheet_table.h"
#include "calibrate/study/slump_sheet.h"
#include "calibrate/study/tests.h"
#include "calibrate/verify/case.h"

namespace pastefit::fuzz {

namespace {

namespace fs = std::filesystem;
const fs::path kSource = PASTEFIT_SOURCE_DIR;

/// A folder in memory where the shipped laboratories and apparatus are found beside the file that is read.
class Desk {
 public:
  Desk() {
    std::string name = "/dev/shm/pastefit-fuzz-XXXXXX";
    if (!::mkdtemp(name.data())) throw std::runtime_error("no folder in /dev/shm");
    folder_ = name;
    for (const char* beside : {"lab", "apparatus"})
      fs::create_directory_symlink(kSource / "data" / beside, folder_ / beside);
    fs::create_directory(folder_ / "read");
  }
  ~Desk() {
    std::error_code error;
    fs::remove_all(folder_, error);
  }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  fs::path with(std::string_view content) const {
    const fs::path file = folder_ / "read" / "file.json";
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return file;
  }

 private:
  fs::path folder_;
};

fs::path file_of(std::string_view content) {
  static const Desk desk;
  return desk.with(content);
}

/// Faults are for people: each says what.
template <class T>
void judge(const Result<T>& read) {
  if (read.ok()) return;
  if (read.faults().empty()) throw std::logic_error("refused without a fault");
  for (const Fault& fault : read.faults())
    if (fault.what.empty()) throw std::logic_error("a fault that says nothing");
  lines_of(message_of(read.faults()));
}

void study(const fs::path& file) {
  const auto read = read_study(file);
  judge(read);
  if (!read.ok()) return;
  inputs_of(read.value());
  if (const Faults faults = validate_residuals(read.value()); !faults.empty())
    throw std::logic_error("a study that was read has no finite residuals: " + message_of(faults));
}

/// A card that was read can be shown, and written so that it reads as the same one.
void card(const fs::path& file) {
  const auto read = read_card(file);
  judge(read);
  if (!read.ok()) return;
  text_of(read.value());
  const auto written = json_text(to_json(read.value()));
  const auto again = card_from_json(nlohmann::json::parse(written));
  if (!again.ok()) throw std::logic_error("a card that was written is refused: " + message_of(again.faults()));
  if (json_text(to_json(again.value())) != written) throw std::logic_error("a card reads as another one");
}

void impact(const fs::path& file) {
  Faults faults;
  if (const auto document = read_json(file, faults)) judge(impact_from_json(*document));
}

/// A row of the store, as JSON; what is no row is refused by an exception, which the store turns into a fault.
void row(const fs::path& file) {
  Faults faults;
  const auto read = read_json(file, faults);
  if (!read || !read->is_object()) return;
  const auto part = [&](const char* name) { return read->value(name, nlohmann::json()); };
  const auto try_to = [](auto read_part) {
    try {
      read_part();
    } catch (const nlohmann::json::exception&) {
    } catch (const std::invalid_argument&) {
    }
  };
  try_to([&] { to_json(readings_from_json(nlohmann::ordered_json(part("observables")))); });
  try_to([&] { to_json(failure_from_json(part("failure"))); });
  try_to([&] { to_json(run_from_json(part("run")), 0); });
  try_to([&] { to_json(sketch_from_json(part("sketch"))); });
  try_to([&] { parameters_to_json(parameters_from_json(part("parameter_values"))); });
}

/// What a person types into `pastefit new`, as JSON; files that are made of it can be read.
void sheet(const fs::path& file) {
  Faults faults;
  const auto typed = read_json(file, faults);
  if (!typed || !typed->is_object()) return;
  Sheet sheet;
  for (const auto& [key, value] : typed->items()) {
    if (!value.is_string()) continue;
    const auto text = value.get<std::string>();
    if (key == "mould")
      sheet.mould = text;
    else if (key == "density")
      sheet.density = text;
    else if (key == "for")
      sheet.target = text;
    else if (key == "title")
      sheet.title = text;
    else if (key == "confirm")
      sheet.confirmed.push_back(text);
    else
      sheet.readings.emplace_back(key, text);
  }
  const auto made = starting_files(sheet, file.parent_path());
  judge(made);
  if (!made.ok()) return;
  std::ofstream(file.parent_path() / "lab.json") << made.value().lab;
  std::ofstream(file.parent_path() / "study.json") << made.value().study;
  if (const auto read = read_study(file.parent_path() / "study.json"); !read.ok())
    throw std::logic_error("a study that was made is refused: " + message_of(read.faults()));
}

/// A laboratory's table; the files of a row can be read.
void table(std::string_view content) {
  Faults faults;
  Sheet defaults;
  defaults.mould = "abrams";
  defaults.density = "2300";
  for (const SheetRow& row : sheet_table(content, defaults, faults).rows) {
    if (row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos)
      throw std::logic_error("a name that is none of a folder: " + row.name);
    const auto made = starting_files(row.sheet, kSource);
    judge(made);
    if (made.ok()) judge(read_lab(file_of(made.value().lab)));
  }
  if (!faults.empty()) judge(Result<int>(faults));
}

/// What `pastefit confirm` takes from a run goes to the card.
void lammps_log(std::string_view content) {
  const LammpsLog log = read_lammps_log(content);
  const bool sane = std::isfinite(log.wall_s) && log.wall_s >= 0 && std::isfinite(log.core_s) && log.core_s >= 0 &&
                    log.ranks >= 0 && log.copies >= 0;
  if (!sane) throw std::logic_error("times or ranks that no run can have");
}

/// Lines of a script that Slurm reads.
std::vector<std::string> slurm_lines(const std::string& script) {
  std::vector<std::string> out;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("#SBATCH")) out.push_back(line);
  return out;
}

/// A folder of a batch, as a line of text: a script has the options that it has for a plain folder, and no pattern of
/// Slurm's but its own.
void slurm_folder(std::string_view content) {
  ArrayJob job;
  job.program = "/usr/bin/pastefit";
  job.directory = "/home";
  job.studies = {"a.json"};
  job.out = "plain";
  const std::size_t usual = slurm_lines(array_job_script(job)).size();
  job.out = std::string(content);
  if (const Faults faults = unusable_in_job(job); !faults.empty()) return judge(Result<int>(faults));
  const auto lines = slurm_lines(array_job_script(job));
  if (lines.size() != usual) throw std::logic_error("the folder's name adds an option of Slurm");
  for (const std::string& line : lines) {
    std::size_t single = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
      if (line[i] == '%') line[i + 1 < line.size() ? i + 1 : i] == '%' ? ++i : ++single;
    if (single > 1) throw std::logic_error("Slurm takes a % of the folder's name for a pattern");
  }
}

constexpr std::array<Reader, 11> kReaders{
    {{"lab", [](std::string_view content) { judge(read_lab(file_of(content))); }},
     {"apparatus", [](std::string_view content) { judge(read_apparatus_file(file_of(content))); }},
     {"study", [](std::string_view content) { study(file_of(content)); }},
     {"card", [](std::string_view content) { card(file_of(content)); }},
     {"physics_case", [](std::string_view content) { judge(read_case(file_of(content))); }},
     {"impact", [](std::string_view content) { impact(file_of(content)); }},
     {"store", [](std::string_view content) { row(file_of(content)); }},
     {"sheet", [](std::string_view content) { sheet(file_of(content)); }},
     {"table", table},
     {"lammps_log", lammps_log},
     {"slurm_folder", slurm_folder}}};

}  // namespace

std::span<const Reader> readers() {
  return kReaders;
}

std::vector<fs::path> corpus_of(const Reader& reader) {
  const fs::path corpus = kSource / "tests/fuzz/corpus";
  std::ifstream table(corpus / "shipped.json");
  std::vector<fs::path> folders{corpus / reader.name};
  const auto shipped = nlohmann::json::parse(table);
  for (const std::string folder : shipped.at(std::string(reader.name))) folders.push_back(kSource / folder);
  std::vector<fs::path> files;
  for (const fs::path& folder : folders)
    if (fs::is_directory(folder))
      for (const auto& entry : fs::directory_iterator(folder))
        if (const auto ending = entry.path().extension(); ending == ".json" || ending == ".txt" || ending == ".csv")
          files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace pastefit::fuzz
