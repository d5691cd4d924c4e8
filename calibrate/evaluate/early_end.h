#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Values of the test's reading that ends it early (`ReadingKind::ends_early`) between which a candidate is worth the
/// rest of its test: nearer to the laboratory's than
///     level = the larger of 8 tolerances and 4 standard deviations of one measurement.
/// Farther off a candidate cannot win, and its likelihood is below e^-8, so that the rest of its readings matters to
/// nobody. The level depends on the study only, not on the best candidate so far: what a candidate answers does not
/// depend on the order of asking. Upwards it serves a test of which readings of later stages are fitted, only.
/// Nothing if the study does not want it (`SearchOptions::end_early`), or that reading is not fitted.
std::optional<Cutoff> cutoff_of(const Study& study, std::size_t test);

/// The store's name of an evaluation that ended early, from that of the whole one.
std::string key_of_ended(const std::string& whole_key, const Cutoff& cutoff);

/// The evaluation of a test as a search sees it that gave it this cutoff, whether it ran to its end or not:
///   - below the cutoff that reading is its lower end, and every other one of its stage and later is missing;
///   - above it the readings of later stages are missing;
///   - `run.ended_early` says so.
/// So what is left reads the same for a run that was ended and for one that was not. A failure stays; one that comes
/// after the run has left it is the only thing that a run that was ended does not show.
StoredEvaluation seen_through(const Test& test, const Cutoff& cutoff, StoredEvaluation evaluation);

/// True if this reading of an evaluation seen through its cutoff is the lower end: it read so or less.
bool is_upper_bound(const Study& study, std::size_t test, std::string_view reading, double value);

/// The evaluation of a name, seen through the cutoff; without one the one that ran to its end.
std::optional<StoredEvaluation> find(const Store& store, const Test& test, const std::string& whole_key,
                                     const std::optional<Cutoff>& cutoff);

}  // namespace pastefit
