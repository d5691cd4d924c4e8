#include "calibrate/cli/lammps_run.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/cli/child_process.h"
#include "calibrate/cli/status_line.h"
#include "calibrate/exports/heap_dump.h"
#include "calibrate/exports/lammps_deck.h"

namespace pastefit {

namespace fs = std::filesystem;

namespace {

const std::string kLog = "log.lammps", kOutput = "output.txt";

/// Nothing of what is no regular file, which may have no end, or is too large for a log or a deck.
std::string content_of_file(const fs::path& file) {
  constexpr std::uintmax_t largest = 256u << 20;
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > largest) return {};
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether this deck ran here to its end before.
bool has_run(const ExportScene& scene, const std::vector<ExportFile>& deck, const fs::path& folder) {
  std::error_code error;
  return std::ranges::all_of(deck,
                             [&](const auto& file) { return content_of_file(folder / file.name) == file.content; }) &&
         std::ranges::all_of(lammps_dumps(scene), [&](const auto& name) { return fs::exists(folder / name, error); }) &&
         read_lammps_log(content_of_file(folder / kLog)).ended;
}

/// The deck without the sources of its program and without the two grains.
Result<std::vector<ExportFile>> deck_of(const ExportScene& scene) {
  auto written = export_lammps(scene);
  if (!written.ok()) return written.faults();
  auto files = std::move(written).value().files;
  std::erase_if(files,
                [](const auto& file) { return file.name.starts_with("style/") || file.name == "in.two_grains"; });
  return files;
}

/// The last lines, which say what went wrong.
std::string tail_of(const std::string& text) {
  constexpr std::size_t kMost = 600;
  std::string tail = text.size() > kMost ? text.substr(text.size() - kMost) : text;
  if (const auto line = tail.find('\n'); text.size() > kMost && line != std::string::npos) tail.erase(0, line + 1);
  while (tail.ends_with('\n')) tail.pop_back();
  return lines_of(tail);
}

/// Where a run is, as its output says: of a run that hangs always the same.
std::string last_line_of(const fs::path& file) {
  constexpr std::size_t most = 60;
  std::string line = tail_of(content_of_file(file));
  if (const auto before = line.rfind('\n'); before != std::string::npos) line.erase(0, before + 1);
  return one_line(line.substr(0, most));
}

/// Why a process that has ended left no heap; nothing if nothing is wrong with it.
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

Result<LammpsHeap> read_heap(const ExportScene& scene, const fs::path& folder) {
  std::vector<Particles> grains;
  for (const auto& name : lammps_dumps(scene)) {
    auto dump = read_dump(folder / name);
    if (!dump.ok()) return dump.faults();
    grains.push_back(std::move(dump).value());
  }
  auto readings = read_heaps(scene.test, std::nullopt, grains[0], std::span(grains).subspan(1));
  if (!readings.ok()) return readings.faults();
  return LammpsHeap{std::move(readings).value(), read_lammps_log(content_of_file(folder / kLog))};
}

}  // namespace

Result<LammpsHeap> run_in_lammps(const ExportScene& scene, const LammpsLaunch& launch, const fs::path& folder,
                                 const std::atomic<bool>& stop) {
  const auto deck = deck_of(scene);
  if (!deck.ok()) return deck.faults();
  std::error_code error;
  if (has_run(scene, deck.value(), folder))
    if (auto heap = read_heap(scene, folder); heap.ok()) return heap;
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
      if (line.is_due()) line.show(format("LAMMPS, %.0f s gone: ", line.gone_s()) + last_line_of(folder / kOutput));
    });
    line.clear();
    if (auto faults = ill_end(end, folder); !faults.empty()) return faults;
  } catch (const std::system_error& failed) {
    return Fault{"LAMMPS", std::string("could not be started: ") + failed.what(), "check memory and disk"};
  }
  return read_heap(scene, folder);
}

}  // namespace pastefit
