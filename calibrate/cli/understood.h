#pragma once

#include <string>

#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Apparatus and grains of a test as the program read them, one line each.
std::string apparatus_in_words(const Test& test);

/// Plan of a calibration: apparatus, grains, target readings, expected time, and free parameters that the readings do
/// not identify. Terminated lines.
std::string understood(const Study& study, int threads = 0);

/// Remarks on the readings of a study, and assumptions on its tests; one line each.
std::string notes_on_readings(const Study& study);

/// Prints the plan of a study before any simulation, with stored results, changes since then, and suspicious readings.
/// `file`: name of the store.
void print_remarks(const Study& study, const Store& store, const std::string& file, int threads);

}  // namespace pastefit
