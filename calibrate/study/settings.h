#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

/// Change of a file's content before it is read, so that all checks of its reader apply.
struct Setting {
  std::string path;  ///< of keys, as in the file: "search.seed", "tests[0].lab"
  nlohmann::json value;
};

Fault no_such_parameter(std::string where, std::string_view name);

/// Parses texts "path=value", as given to --set. A value that is not JSON is a text. Errors: no path; control
/// characters, or bytes that are not UTF-8.
std::vector<Setting> read_settings(const std::vector<std::string>& texts, Faults& faults);

/// Sets the value at its path. New keys are added: the reader of the file reports unknown ones. Error: the path does
/// not lead to a place in the file.
void apply(const Setting& setting, nlohmann::json& document, Faults& faults);

/// Reads a study with changes of its file's content ("path=value"), which `Study::settings` keeps.
/// `parameters.NAME.lower` and `parameters.NAME.upper` are the bounds of a free parameter. A changed study has another
/// hash than its file. Errors: those of `read_settings`, `apply` and `read_study`.
Result<Study> read_study_with(const std::filesystem::path& file, const std::vector<std::string>& texts);

}  // namespace pastefit
