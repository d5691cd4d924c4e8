#pragma once

#include <string>

#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// What the laboratories' readings look like, taken together, and what was assumed of their tests; a line each.
std::string notes_on_readings(const Study& study);

/// Tells a person of a study before anything of it runs: what was understood, what is known from before and what has
/// changed since, what is odd about the readings. `file`: the store's.
void print_remarks(const Study& study, const Store& store, const std::string& file, int threads);

}  // namespace pastefit
