#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Apparatus file of data/apparatus: an apparatus with default material, default grains and customary readings; a
/// laboratory file without measurements.
struct Apparatus {
  std::string title;
  Test test;                           ///< contact parameters have their default values
  std::vector<Measurement> readings;   ///< customary ones, with their keys and usual values; may be empty
  std::vector<std::string> standards;  ///< whose apparatus it is, e.g. "EN 12350-2"; may be empty
  std::string caution;                 ///< warning for every user: a sentence without a full stop
  std::filesystem::path file;          ///< empty if not read from a file
  /// The file without comments, white space and what does not affect simulations (readings, caution). Part of the hash
  /// of every file that uses it.
  std::string content;
};

/// Parses the content of an apparatus file. Errors: every fault, with its place.
Result<Apparatus> apparatus_from_json(const nlohmann::json& document);

/// Reads an apparatus file ("format": "pastefit-rig-1"). Errors: every fault, with the file name.
Result<Apparatus> read_apparatus_file(const std::filesystem::path& file);

std::vector<std::string> preset_names(const std::filesystem::path& folder);

/// Finds a preset by its name in a file in `folder`. Errors: no such preset, or a faulty one.
Result<Apparatus> find_preset(const std::string& name, const std::filesystem::path& folder);

/// Name of the preset whose apparatus is that of a standard, as people write it: "DIN EN 12350-5:2019", "ASTM
/// C143/C143M", "C143". Other names are returned without blanks at their ends.
std::string preset_of_standard(const std::string& name, const std::filesystem::path& folder);

/// Search path of presets, in order: `../apparatus` relative to `folder`, the folder of the naming file; then
/// `apparatus` in each data folder (`data_folders`).
std::vector<std::filesystem::path> apparatus_folders(const std::filesystem::path& folder);

// Sections shared by apparatus and laboratory files.

void read_provenance(ObjectReader& document, Provenance& provenance);

/// Reads "test", the kind of test; default: slump test. `test` then has default values.
void read_kind(ObjectReader& document, Test& test);

/// Reads "apparatus". If `folder`, that of the file, is given, the object may name a preset, whose values its own keys
/// override. Returns the preset, from which `test` then starts, if one was read.
std::optional<Apparatus> read_apparatus(ObjectReader& document, Test& test,
                                        const std::optional<std::filesystem::path>& folder);

/// Reads "material". `further` reads the keys that only one of the two kinds of files has.
void read_material(ObjectReader& document, Test& test, const std::function<void(ObjectReader& material)>& further = {});
void read_grains(ObjectReader& document, Test& test, Need need);

}  // namespace pastefit
