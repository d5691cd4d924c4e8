#pragma once

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Reads "search" of a study in which so many tests are fitted.
void read_search_options(ObjectReader& document, int fitted_tests, SearchOptions& search);

/// Reads "free", "scale" and "prior" of a parameter. `range`: where it is admissible.
void read_free(ObjectReader& reader, const Range& range, Parameter& parameter);

}  // namespace pastefit
