#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/laboratory/sketch.h"
#include "calibrate/laboratory/test.h"

namespace pastefit {

/// What a store is opened for.
struct StoreIdentity {
  std::string program;  ///< version and engine fingerprint; evaluations of another one answer for nothing
  std::string inputs;   ///< all that decides the way of the search, as JSON text (`inputs_of` a study)
};

/// Readings are in mm, Pa, kg or shares, none of which comes near it; beyond it squares of them would not be finite,
/// and nothing of the kind is kept.
inline constexpr double kLargestReading = 1e15;

/// One finished simulation, as it is kept.
struct StoredEvaluation {
  std::string key;                 ///< from `evaluation_key`
  std::vector<double> point;       ///< coordinates in the unit cube over the free parameters
  std::vector<double> values;      ///< of every parameter, in the order of `parameter_kinds`
  std::uint64_t packing = 0;       ///< packing seed
  int epoch = 0;                   ///< number of the inputs it was made for; set by the store
  Readings readings;               ///< all readings, measured in the laboratory or not; empty after a failure
  std::optional<Failure> failure;  ///< why there are no readings
  RunSummary run;
  Sketch sketch;      ///< without points if there is none
  double wall_s = 0;  ///< time the simulation took
  double core_s = 0;  ///< processor time; 0: not known, as of an older store or a foreign simulator
};

/// Name of an evaluation: 64-bit FNV-1a over the program and the exact bits of all that the test (its packing seed
/// included) has different from the default one, as 16 hexadecimal digits: what is added to tests and has its default
/// value here, a parameter or an optional field, leaves the name as it was. Two evaluations with the same key are (up
/// to a chance of 2^-64 a pair) answered by the engine with the same bits. What the laboratory measured (but for an
/// outline, with which the heap is compared), the bounds and the budget are not in it: an evaluation outlives a change
/// of these.
std::string evaluation_key(std::string_view program, const Test& test);

/// The record of every finished evaluation, an SQLite file in write-ahead mode with full synchronisation.
/// Each evaluation is one transaction: after `add` has returned, it survives the death of the process and of the
/// machine. Safe to use from several threads; for one process at a time.
///
/// Table `evaluations`: sequence (order of arrival), key, epoch, point, parameter_values, packing, readings,
/// failure, run (with the sketch), checksum; point to run as JSON text with doubles that read back bit for bit, the
/// parameters by name, those only that do not have their default value; the checksum is of all before it. Table
/// `set_aside`: rows that were found not to agree with theirs. Table `identity`: the program, and how many evaluations
/// were ever written. Table `inputs`: epoch, content, checksum; one row for each change of the study or its laboratory
/// files.
///
/// A search that goes on after such a change knows the evaluations of earlier epochs from the start; those of its own
/// epoch only answer when it asks for them again, so that a run that was killed takes the same way.
class Store {
 public:
  /// Opens the store in `file`, or creates it. Nothing that stands in the file is changed before it has passed.
  /// Other inputs than the last ones begin a new epoch, which is in the file with the first evaluation that is added.
  /// Errors: not a database, damaged, not a store, other schema version, belongs to another program, in use, not
  /// writable.
  static Result<Store> open(const std::filesystem::path& file, const StoreIdentity& identity);

  /// Opens a store to look at what it holds, whichever program and inputs it is of; nothing is to be added.
  /// Errors: there is no such file, not a database, damaged, not a store, other schema version.
  static Result<Store> read(const std::filesystem::path& file);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  const StoreIdentity& identity() const;
  int epoch() const;  ///< of what is added now
  /// What has changed in the inputs since the store was last opened, as places in them ("study.parameters.friction");
  /// empty if nothing has.
  const std::vector<std::string>& changes() const;

  /// What the store has lost since it was written: rows that do not agree with their checksum, that are missing, or all
  /// of them; empty if nothing. What is damaged is set aside, and answers nothing.
  const std::vector<std::string>& remarks() const;

  /// The evaluation with this key, if it is known.
  std::optional<StoredEvaluation> find(std::string_view key) const;

  /// Keeps the evaluation; one whose key is already known changes nothing. Errors: the disk is full or failed; the
  /// evaluation is then not kept.
  Faults add(const StoredEvaluation& evaluation);

  /// Everything kept, in the order of arrival.
  std::vector<StoredEvaluation> all() const;

  std::size_t size() const;

 private:
  struct State;
  explicit Store(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace pastefit
