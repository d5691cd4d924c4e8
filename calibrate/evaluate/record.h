#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/objective.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

// Between a study's candidates and the store's evaluations: one evaluation is a candidate in one test on one packing.

/// The store's name of a candidate (values of all parameters) in one test on one packing.
std::string key_of(const Study& study, std::size_t test, std::span<const double> values, std::uint64_t packing,
                   std::string_view program);

/// Why an evaluation cannot be used by the study: its own failure, or a measured reading that is missing (though it did
/// not end early) or no number.
std::optional<Failure> failure_of(const StudyTest& test, const StoredEvaluation& evaluation);

/// How near the run is to one that a laboratory would reject, e.g. a heap that sheared off: the highest of these tests
/// (`rejection_index` of each). `merged`: as `merged` gives it. NaN: none of them read it.
double rejection_index(const Study& study, std::span<const std::size_t> tests, const StoredEvaluation& merged);

/// What share of a candidate's heaps may be rejected; 1 if no fitted test is of a kind of which runs are.
double rejected_share_of(const Study& study);

/// A candidate on one packing in several tests as one evaluation: the readings under their names in the study, and the
/// first failure. Shape: one evaluation for each of `tests`.
StoredEvaluation merged(const Study& study, std::span<const std::size_t> tests,
                        std::span<const StoredEvaluation> evaluations);

/// What the store has of a candidate in one test on these packings, in their order; nothing if one of them is missing
/// or failed. Simulates nothing.
std::vector<Readings> known_runs(const Study& study, std::size_t test, const UnitPoint& point,
                                 std::span<const std::uint64_t> packings, const Store& store);

/// How many of the store's evaluations are of a test of the study, whatever the candidate.
std::size_t holding(const Study& study, const Store& store);

/// `Store::changes`, one after the other.
std::string changed_places(const Store& store);

/// A store of which nothing is of the study's tests: going on would mix two laboratories in one folder. `file`: the
/// store's.
Faults strangers_in(const Study& study, const Store& store, const std::string& file);

/// Candidates of earlier epochs of the store that hold for the study as it is now: same tests, same fixed values, free
/// ones within the bounds, and known in all fitted tests. Their points are those of the present bounds; they are
/// ordered by values and packing.
std::vector<StoredEvaluation> earlier_of(const Study& study, const Store& store);

/// Everything the store holds of the study as it is now, whatever search asked for it, in the same order: each
/// candidate on each packing once, run to its end where that is known. The store may be of another program.
std::vector<StoredEvaluation> everything_of(const Study& study, const Store& store);

/// Everything a search knows in the end: what earlier epochs left, and the record of what it has asked, each candidate
/// on each packing once, in the order of asking: the same whatever else the store holds and in whichever order it came
/// in. What a stop cut off is not there.
std::vector<StoredEvaluation> record_of(const Study& study, const Store& store, std::span<const Response> history);

}  // namespace pastefit
