#pragma once

#include <string>

#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Apparatus and grains of a test as the program took them, a line each.
std::string apparatus_in_words(const Test& test);

/// What a calibration will do: apparatus, grains, readings to be met, time expected; and free parameters of which the
/// readings say nothing. Lines, each ended.
std::string understood(const Study& study, int threads = 0);

/// What the laboratories' readings look like, taken together, and what was assumed of their tests; a line each.
std::string notes_on_readings(const Study& study);

/// Tells a person of a study before anything of it runs: what was understood, what is known from before and what has
/// changed since, what is odd about the readings. `file`: the store's.
void print_remarks(const Study& study, const Store& store, const std::string& file, int threads);

}  // namespace pastefit
