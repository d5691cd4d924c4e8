#pragma once

#include <string>
#include <vector>

#include "calibrate/batch/batch_table.h"

namespace pastefit {

/// The table as one page of HTML that asks nothing of a network and runs no script, the worst verdicts on top. A study
/// is a link to the page in its own folder, relative to where this page lies.
std::string batch_page(const std::vector<BatchRow>& rows);

}  // namespace pastefit
