#include "calibrate/cli/lammps_program.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/content_hash.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/child_process.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/exports/lammps_deck.h"

namespace pastefit {

namespace fs = std::filesystem;

namespace {

const fs::path kLammpsHeaders = "/usr/include/lammps";
const std::string kOrProgram = ", or give a LAMMPS with the styles with --program";

bool can_be_run(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

/// The file that a shell would start; empty: there is none.
fs::path program_file(const std::string& name) {
  if (name.find('/') != std::string::npos) return can_be_run(name) ? fs::absolute(name) : fs::path();
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (can_be_run(fs::path(folder.empty() ? "." : folder) / name)) return fs::absolute(fs::path(folder) / name);
  return {};
}

/// Where built programs are kept; empty: the user has no home.
fs::path cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) return fs::path(cache) / "pastefit";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "pastefit";
  return {};
}

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
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
                      "neither XDG_CACHE_HOME nor HOME says where to keep LAMMPS with the card's laws",
                      "set one of them" + kOrProgram});
  return faults;
}

/// Compiles in a folder of its own beside the program, which appears whole or not at all.
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

}  // namespace

bool is_program(const std::string& name) {
  return !program_file(name).empty();
}

Result<fs::path> lammps_program(const std::string& given, const std::atomic<bool>& stop) {
  if (!given.empty()) {
    const fs::path program = program_file(given);
    if (program.empty())
      return Fault{"--program", one_line(given) + " is no program that can be run",
                   "check the path and its permissions"};
    return program;
  }
  const auto sources = lammps_style();
  if (!sources.ok()) return sources.faults();
  std::string content = text_in(kLammpsHeaders / "version.h");
  for (const ExportFile& file : sources.value()) content += file.name + file.content;
  const fs::path program = cache_folder() / ("lmp_pastefit-" + content_hash(content));
  if (!cache_folder().empty() && can_be_run(program)) return program;
  if (auto faults = missing_for_build(); !faults.empty()) return faults;
  if (auto faults = build(sources.value(), program, stop); !faults.empty()) return faults;
  return program;
}

}  // namespace pastefit
