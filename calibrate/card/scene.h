#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>
#include <vector>

#include "calibrate/laboratory/test.h"
#include "core/apparatus/impact/impact.h"
#include "core/result.h"

namespace pastefit {

using Scene = std::variant<Test, Impact>;

/// Simulates a scene. Requirement: its `validate` is empty.
Outcome simulate(const Scene& scene, const RunOptions& options);

/// Scene of a file, with notes on its source for the user; mostly none.
struct FoundScene {
  Scene scene;
  std::vector<std::string> notes;
};

/// Reads the test of a file: of a study (free parameters in the middle of their bounds), a card, a laboratory or an
/// apparatus file, or the bodies of an impact file, distinguished by "format". `test`: name of the test in a study or a
/// card; empty: the first one.
///
/// Each of `settings` is "path=value" and changes the file's content before it is read, so that all checks apply.
/// `parameters.NAME=number` sets a parameter of `parameter_kinds` in every file of a laboratory test. In a study, paths
/// in contact, search, weights, tolerances and tests belong to the study; others belong to its laboratory file, e.g.
/// grains.radius_mm=6. A value that is not JSON is a text. Errors: all faults of the file and of the settings; no such
/// test.
Result<FoundScene> read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings,
                              const std::string& test);

/// The same from the content of such a file. `file`: prefix of places, empty for none; files named in the content are
/// searched in its folder.
Result<FoundScene> scene_from_json(const nlohmann::json& document, const std::filesystem::path& file,
                                   const std::vector<std::string>& settings, const std::string& test);

}  // namespace pastefit
