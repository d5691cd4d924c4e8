#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "calibrate/report/findings.h"

namespace pastefit {

/// All that the page says, but the grains of its films (`recording_bytes`), as the page's program reads it
/// (calibrate/report/page/content.js). What findings lack is null or empty; `missing` says why.
/// `command`: what makes the page again, for people.
nlohmann::ordered_json page_content(const Findings& findings, const std::string& command);

}  // namespace pastefit
