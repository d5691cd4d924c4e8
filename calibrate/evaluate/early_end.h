#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Range of the reading that ends a test early (`ReadingKind::ends_early`). Within it a candidate runs to its end,
/// beyond it a run may be stopped. Its limits differ from the measurement by
///     level = the larger of 8 tolerances and 4 standard deviations of one measurement.
/// Beyond them a candidate cannot win and its likelihood is below e^-8, so that further readings do not matter. The
/// level depends on the study only, so that evaluations do not depend on the order of asking. The upper limit is used
/// only if readings of later stages are fitted. Empty if the study disables it (`SearchOptions::end_early`) or does not
/// fit that reading.
std::optional<Cutoff> cutoff_of(const Study& study, std::size_t test);

/// Store key of an evaluation that ended early, from the key of the complete one.
std::string key_of_ended(const std::string& whole_key, const Cutoff& cutoff);

/// Censors an evaluation by a cutoff, whether it ran to its end or not:
///   - below the cutoff its lower end replaces the reading, and all others of its stage and later are missing;
///   - above the cutoff the readings of later stages are missing;
///   - `run.ended_early` is true.
/// Stopped and complete runs thus give the same readings. A failure is kept; the only difference is a failure after the
/// run has left the range.
StoredEvaluation seen_through(const Test& test, const Cutoff& cutoff, StoredEvaluation evaluation);

/// True if a censored reading is the lower end of the cutoff, an upper bound of the true reading.
bool is_upper_bound(const Study& study, std::size_t test, std::string_view reading, double value);

/// Evaluation of a key, censored by the cutoff; without cutoff the complete one.
std::optional<StoredEvaluation> find(const Store& store, const Test& test, const std::string& whole_key,
                                     const std::optional<Cutoff>& cutoff);

}  // namespace pastefit
