#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit::fuzz {

/// A reader of the program's files, as it is attacked: whatever `content` is, it is read, or refused with faults.
/// Errors: `std::logic_error` if a fault says nothing, or what was read does not read as the same again.
struct Reader {
  std::string_view name;
  void (*read)(std::string_view content);
};

/// lab, apparatus, study, card, physics_case, impact, store, a row of the store, sheet, what is typed into
/// `pastefit new`, table, a laboratory's CSV file, lammps_log, what `pastefit confirm` reads of a run, and
/// slurm_folder, the folder of a batch.
std::span<const Reader> readers();

/// What the attack on a reader starts from: the shipped files that it reads (corpus/shipped.json), and those that it
/// once could not cope with or that no shipped file stands for (corpus/<name>). Sorted by name.
std::vector<std::filesystem::path> corpus_of(const Reader& reader);

}  // namespace pastefit::fuzz
