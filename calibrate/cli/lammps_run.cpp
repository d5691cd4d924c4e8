#include "calibrate/cli/lammps_run.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/input_file.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/process.h"
#include "calibrate/cli/progress.h"
#include "calibrate/cli/terminal.h"
#include "calibrate/exports/heap_dump.h"
#include "calibrate/exports/lammps_deck.h"

namespace pastefit {

namespace fs = std::filesystem;

namespace {

const fs::path kLammpsHeaders = "/usr/include/lammps";
const std::string kOrProgram = ", or give a LAMMPS that has the styles with --program";

bool can_be_run(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

/// File that a shell would start; may be empty.
fs::path program_file(const std::string& name) {
  if (name.find('/') != std::string::npos) return can_be_run(name) ? fs::absolute(name) : fs::path();
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (can_be_run(fs::path(folder.empty() ? "." : folder) / name)) return fs::absolute(fs::path(folder) / name);
  return {};
}

/// Cache of built programs; empty if the user has no home.
fs::path cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) return fs::path(cache) / "pastefit";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "pastefit";
  return {};
}

/// Content of a regular file, limited to the size of logs and decks; empty for other files, which may be endless.
std::string content_of_file(const fs::path& file) {
  auto content = read_input(file, {.largest_bytes = 256u << 20, .remedy = {}});
  return content.ok() ? std::move(content).value() : std::string();
}

Faults missing_for_build() {
  Faults faults;
  if (!is_program("mpicxx"))
    faults.push_back({"--engine lammps", "there is no compiler mpicxx to build LAMMPS with the card's laws",
                      "install Debian's g++ and libopenmpi-dev" + kOrProgram});
  if (std::error_code error; !fs::exists(kLammpsHeaders / "lammps.h", error))
    faults.push_back({"--engine lammps", "LAMMPS's headers are not in " + kLammpsHeaders.string(),
                      "install Debian's liblammps-dev" + kOrProgram});
  if (cache_folder().empty())
    faults.push_back({"--engine lammps",
                      "neither XDG_CACHE_HOME nor HOME is set, so there is no folder for LAMMPS with the card's laws",
                      "set one of them" + kOrProgram});
  return faults;
}

/// Compiles in a separate folder beside the program, which is then moved into place as a whole.
Faults build(const std::vector<ExportFile>& sources, const fs::path& program, const std::atomic<bool>& stop) {
  const fs::path folder = program.string() + "." + std::to_string(::getpid()) + ".build";
  std::error_code error;
  for (const ExportFile& file : sources) {
    fs::create_directories((folder / file.name).parent_path(), error);
    if (auto faults = write_atomically(folder / file.name, file.content); !faults.empty()) return faults;
  }
  note("building LAMMPS with the card's laws, once\n");
  const ChildEnd end = run_in_shell(lammps_style_build("program"), folder, folder / "output.txt", stop);
  const bool built = end.status == 0 && end.signal == 0;
  if (built) fs::rename(folder / "program", program, error);
  fs::remove_all(folder, error);
  if (built && fs::exists(program, error)) return {};
  return {{"--engine lammps",
           "LAMMPS with the card's laws could not be built:\n" + lines_of(end.output.substr(0, 2000)),
           "install Debian 12's g++, libopenmpi-dev and liblammps-dev" + kOrProgram}};
}

const std::string kLog = "log.lammps", kOutput = "output.txt";

/// True if this deck has already completed in this folder.
bool has_run(const ExportScene& scene, const std::vector<ExportFile>& deck, const fs::path& folder) {
  std::error_code error;
  return std::ranges::all_of(deck,
                             [&](const auto& file) { return content_of_file(folder / file.name) == file.content; }) &&
         std::ranges::all_of(lammps_dumps(scene), [&](const auto& name) { return fs::exists(folder / name, error); }) &&
         read_lammps_log(content_of_file(folder / kLog)).ended;
}

/// The deck without the sources of the style and without the two-grain deck.
Result<std::vector<ExportFile>> deck_of(const ExportScene& scene) {
  auto written = export_lammps(scene);
  if (!written.ok()) return written.faults();
  auto files = std::move(written).value().files;
  std::erase_if(files,
                [](const auto& file) { return file.name.starts_with("style/") || file.name == "in.two_grains"; });
  return files;
}

/// Last lines of a text, which contain the error.
std::string tail_of(const std::string& text) {
  constexpr std::size_t kMost = 600;
  std::string tail = text.size() > kMost ? text.substr(text.size() - kMost) : text;
  if (const auto line = tail.find('\n'); text.size() > kMost && line != std::string::npos) tail.erase(0, line + 1);
  while (tail.ends_with('\n')) tail.pop_back();
  return lines_of(tail);
}

/// Last output line, which shows the progress; it stays the same if a run hangs.
std::string last_line_of(const fs::path& file) {
  constexpr std::size_t most = 60;
  std::string line = tail_of(content_of_file(file));
  if (const auto before = line.rfind('\n'); before != std::string::npos) line.erase(0, before + 1);
  return one_line(line.substr(0, most));
}

/// Reasons why a finished process left no heap; may be empty.
Faults ill_end(const ChildEnd& end, const fs::path& folder) {
  const LammpsLog said = read_lammps_log(end.output);
  const std::string look = "look at " + (folder / kOutput).string();
  if (!said.error.empty()) return {{"LAMMPS", one_line(said.error), look}};
  if (end.signal != 0) return {{"LAMMPS", "was killed by signal " + std::to_string(end.signal), look}};
  if (end.status != 0)
    return {{"LAMMPS", "ended with status " + std::to_string(end.status) + ":\n" + tail_of(end.output), look}};
  if (said.copies > 1)
    return {{"--launch",
             "started " + std::to_string(said.copies) + " separate copies of LAMMPS instead of one on many ranks",
             "use the launcher of the MPI that LAMMPS was built with"}};
  return {};
}

Result<LammpsHeap> read_heap(const ExportScene& scene, const fs::path& folder, const std::atomic<bool>& stop) {
  std::vector<Particles> grains;
  for (const auto& name : lammps_dumps(scene)) {
    auto dump = read_dump(folder / name);
    if (!dump.ok()) return dump.faults();
    grains.push_back(std::move(dump).value());
  }
  auto readings = read_heaps(scene.test, std::nullopt, grains[0], std::span(grains).subspan(1), shown_run(&stop));
  if (!readings.ok()) return readings.faults();
  LammpsHeap heap{std::move(readings).value(), read_lammps_log(content_of_file(folder / kLog))};
  if (heap.log.slide_angle_deg) heap.readings.set("tilt.slide_angle_deg", *heap.log.slide_angle_deg);
  return heap;
}

}  // namespace

bool is_program(const std::string& name) {
  return !program_file(name).empty();
}

Result<fs::path> lammps_program(const std::string& given, const std::atomic<bool>& stop) {
  if (!given.empty()) {
    const fs::path program = program_file(given);
    if (program.empty())
      return Fault{"--program", one_line(given) + " is not an executable program",
                   "check the path and its permissions"};
    return program;
  }
  const auto sources = lammps_style();
  if (!sources.ok()) return sources.faults();
  std::string content = content_of_file(kLammpsHeaders / "version.h");
  for (const ExportFile& file : sources.value()) content += file.name + file.content;
  const fs::path program = cache_folder() / ("lmp_pastefit-" + content_hash(content));
  if (!cache_folder().empty() && can_be_run(program)) return program;
  if (auto faults = missing_for_build(); !faults.empty()) return faults;
  if (auto faults = build(sources.value(), program, stop); !faults.empty()) return faults;
  return program;
}

Result<LammpsHeap> run_in_lammps(const ExportScene& scene, const LammpsLaunch& launch, const fs::path& folder,
                                 const std::atomic<bool>& stop) {
  const auto deck = deck_of(scene);
  if (!deck.ok()) return deck.faults();
  std::error_code error;
  if (has_run(scene, deck.value(), folder))
    if (auto heap = read_heap(scene, folder, stop); heap.ok()) return heap;
  fs::create_directories(folder, error);
  auto stale = lammps_dumps(scene);
  stale.push_back(kLog);
  for (const auto& name : stale) fs::remove(folder / name, error);
  for (const ExportFile& file : deck.value())
    if (auto faults = write_atomically(folder / file.name, file.content); !faults.empty()) return faults;
  const std::string command =
      "exec " + launch.launcher + " " + shell_word(launch.program.string()) + " -in " + kLammpsDeck;
  try {
    StatusLine line;
    const ChildEnd end = run_in_shell(command, folder, folder / kOutput, stop, [&] {
      line.look([&] { return format("LAMMPS, %.0f s gone: ", line.gone_s()) + last_line_of(folder / kOutput); });
    });
    line.clear();
    if (auto faults = ill_end(end, folder); !faults.empty()) return faults;
  } catch (const std::system_error& failed) {
    return Fault{"LAMMPS", std::string("could not be started: ") + failed.what(), "check memory and disk"};
  }
  return read_heap(scene, folder, stop);
}

}  // namespace pastefit
