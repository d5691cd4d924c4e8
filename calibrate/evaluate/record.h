#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

// Maps candidates of a study to evaluations of the store: one for each candidate, test and packing.

/// Store key of a candidate (values of all parameters) in one test on one packing.
std::string key_of(const Study& study, std::size_t test, std::span<const double> values, std::uint64_t packing,
                   std::string_view program);

/// Why the study cannot use an evaluation: its failure, or a measured reading that is not finite or missing (unless it
/// ended early).
std::optional<Failure> failure_of(const StudyTest& test, const StoredEvaluation& evaluation);

/// Largest `rejection_index` of these tests; beyond 1 a laboratory rejects the run, e.g. a sheared-off heap. `merged`:
/// result of `merged`. NaN: no test has one.
double rejection_index(const Study& study, std::span<const std::size_t> tests, const StoredEvaluation& merged);

/// Largest accepted share of rejected heaps; 1 if no fitted test rejects heaps.
double rejected_share_of(const Study& study);

/// Merges the evaluations of one candidate and packing in several tests: readings under their names in the study, and
/// the first failure. Shape: one evaluation for each of `tests`.
StoredEvaluation merged(const Study& study, std::span<const std::size_t> tests,
                        std::span<const StoredEvaluation> evaluations);

/// Stored readings of a candidate in one test on these packings, in their order; empty if one is missing or failed.
/// Simulates nothing.
std::vector<Readings> known_runs(const Study& study, std::size_t test, const UnitPoint& point,
                                 std::span<const std::uint64_t> packings, const Store& store);

/// Error if a store has evaluations, but none of the study's tests: resuming would mix two laboratory files in one
/// folder. `file`: of the store.
Faults strangers_in(const Study& study, const Store& store, const std::string& file);

/// Candidates of earlier epochs of the store that are valid for the present study: same tests, same fixed values, free
/// values within the bounds, known in all fitted tests. Their points refer to the present bounds. Sorted by values and
/// packing.
std::vector<StoredEvaluation> earlier_of(const Study& study, const Store& store);

/// All stored candidates that are valid for the present study, from any search, in the same order: each candidate and
/// packing once, complete where available. The store may belong to another program.
std::vector<StoredEvaluation> everything_of(const Study& study, const Store& store);

/// Final record of a search: candidates of earlier epochs, then those of `history` in the order of asking, each
/// candidate and packing once. It does not depend on other content or on the order of the store. Runs cut off by a stop
/// are left out.
std::vector<StoredEvaluation> record_of(const Study& study, const Store& store, std::span<const Response> history);

}  // namespace pastefit
