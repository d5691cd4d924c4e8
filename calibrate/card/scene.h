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

/// A test that can be simulated.
using Scene = std::variant<Test, Impact>;

/// The outcome of a scene of either kind. Requirement: its `validate` is empty.
Outcome simulate(const Scene& scene, const RunOptions& options);

/// A scene of a file, and what a person should know of where it comes from; mostly nothing.
struct FoundScene {
  Scene scene;
  std::vector<std::string> notes;
};

/// The test that a file stands for: that of a study (free parameters in the middle of their bounds), a card,
/// a laboratory or an apparatus file, or the few bodies of an impact file, told apart by "format". Of the tests of a
/// study or a card the one named `test`; the first, if that is empty.
///
/// Each of `settings` is "path=value" and changes the file's content before it is read, so that every check applies.
/// A study's own are contact, search, weights, tolerances and tests.
/// `parameters.NAME=number` sets a parameter of `parameter_kinds` in every file of a laboratory test. In a study any
/// other path is one of its laboratory file's, e.g. grains.radius_mm=6. A value that is not JSON is a text.
/// Errors: every fault of the file and of the settings; there is no such test.
Result<FoundScene> read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings,
                              const std::string& test);

/// The same for what such a file says. `file`: the name that places begin with, empty for none; what it names is looked
/// for in its folder.
Result<FoundScene> scene_from_json(const nlohmann::json& document, const std::filesystem::path& file,
                                   const std::vector<std::string>& settings, const std::string& test);

}  // namespace pastefit
