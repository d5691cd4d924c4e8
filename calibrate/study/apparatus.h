#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// A reading that is customary with an apparatus, its usual value and the standard deviation of one, in its unit.
struct CustomaryReading {
  std::string key;  ///< in laboratory files
  double value = 0, standard_deviation = 0;
};

/// An apparatus file of data/apparatus: an apparatus with a default material, default grains and the readings that are
/// customary with it; a laboratory file without what was measured.
struct Apparatus {
  std::string title;
  Provenance provenance;
  Test test;                               ///< contact parameters have their default values
  std::vector<CustomaryReading> readings;  ///< empty if the file names none
  std::string caution;                     ///< what everybody who uses it must know: a sentence without a full stop
  std::filesystem::path file;              ///< empty if it was read from no file
  /// Of the file, without comments, white space and what no simulation depends on: readings and caution. Part of the
  /// hash of whoever uses it.
  std::string content;
};

/// An apparatus file's content as a `Apparatus`. Errors: every fault of the content, each with its place.
Result<Apparatus> apparatus_from_json(const nlohmann::json& document);

/// Reads an apparatus file ("format": "pastefit-rig-1"). Errors: every fault of the file, each with the file's name.
Result<Apparatus> read_apparatus_file(const std::filesystem::path& file);

/// What a person should know of a preset that lies beside the file which names it: "the preset abrams is
/// /mine/apparatus/abrams.json, not the shipped one"; empty for one that is shipped.
std::string note_on_preset(const Apparatus& preset);

/// The preset's caution, unless the test takes readings that the preset's own apparatus does not.
std::string caution_of(const Apparatus& preset, const Test& test);

/// Names of the presets that a file in `folder` may name.
std::vector<std::string> preset_names(const std::filesystem::path& folder);

/// The preset of this name, as a file in `folder` would name it. Error: there is none, or it is faulty.
Result<Apparatus> find_preset(const std::string& name, const std::filesystem::path& folder);

/// The folders in which presets are looked for, in order: `../apparatus` seen from `folder`, where the naming file
/// lies; `apparatus` in each folder of data (`data_folders`).
std::vector<std::filesystem::path> apparatus_folders(const std::filesystem::path& folder);

// Sections of a file, shared by apparatus and laboratory files.

void read_provenance(ObjectReader& document, Provenance& provenance);

/// Which test it is, "test": a slump test if it does not say. `test` then has default values.
void read_kind(ObjectReader& document, Test& test);

/// The object "apparatus". With a folder (where the file lies) it may name a preset; own keys then only differ from it.
/// Returns the preset, if one was read; `test` then starts from it.
std::optional<Apparatus> read_apparatus(ObjectReader& document, Test& test,
                                        const std::optional<std::filesystem::path>& folder);

/// The object "material". `further` reads what only one of both kinds of files has.
void read_material(ObjectReader& document, Test& test, const std::function<void(ObjectReader& material)>& further = {});
void read_grains(ObjectReader& document, Test& test, Need need);

/// Whether all values could be read: unknown keys are the only faults from `first` on.
bool values_are_good(const Faults& faults, std::size_t first);

}  // namespace pastefit
