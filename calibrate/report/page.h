#pragma once

#include <string>

#include "calibrate/report/findings.h"

namespace pastefit {

/// The findings as one HTML file that needs nothing else: the page of `calibrate/report/page`, which is part of this
/// program, with their content (`page_content`) and films in it. Texts of others cannot become markup of it.
std::string page_of(const Findings& findings, const std::string& command);

}  // namespace pastefit
