#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/laboratory/sketch.h"
#include "calibrate/laboratory/test.h"

namespace pastefit {

struct StoreIdentity {
  std::string program;  ///< version and engine fingerprint; evaluations of others are not reused
  std::string inputs;   ///< all that determines the path of the search, as JSON text (`inputs_of` a study)
};

/// Largest reading that is stored, far beyond any in mm, Pa, kg or shares; squares of larger ones could be infinite.
inline constexpr double kLargestReading = 1e15;

/// One finished simulation, as stored.
struct StoredEvaluation {
  std::string key;                 ///< from `evaluation_key`
  std::vector<double> point;       ///< coordinates in the unit cube over the free parameters
  std::vector<double> values;      ///< of all parameters, in the order of `parameter_kinds`
  std::uint64_t packing = 0;       ///< packing seed
  int epoch = 0;                   ///< number of its inputs; set by the store
  Readings readings;               ///< all readings, measured or not; empty after a failure
  std::optional<Failure> failure;  ///< why there are no readings
  RunSummary run;
  Sketch sketch;      ///< no points: none
  double wall_s = 0;  ///< wall time of the simulation
  double core_s = 0;  ///< processor time; 0: unknown (older store, other simulator)
};

/// Key of an evaluation: 64-bit FNV-1a over the program and the exact bits of everything in which the test (its packing
/// seed included) differs from the default test, as 16 hexadecimal digits. A new parameter or optional field of tests
/// therefore leaves keys unchanged while it has its default value. The engine gives the same bits for equal keys, up to
/// a chance of 2^-64 for each pair. Measurements (except an outline, which is compared with the heap), bounds and
/// budget are not part of the key: evaluations remain valid if these change.
std::string evaluation_key(std::string_view program, const Test& test);

/// Record of all finished evaluations, an SQLite file in write-ahead mode with full synchronisation. Each evaluation is
/// one transaction: after `add` has returned, it survives a crash of the process or of the machine. Thread-safe; for
/// one process at a time. Copies are the same store.
///
/// Table `evaluations`: sequence (order of arrival), key, epoch, point, parameter_values, packing, readings, failure,
/// run (with the sketch), checksum; point to run as JSON text with doubles that read back bit for bit, parameters by
/// name and only those without their default value; the checksum covers all before it. Table `set_aside`: rows with a
/// wrong checksum. Table `identity`: the program, and the number of evaluations ever written. Table `inputs`: epoch,
/// content, checksum; one row for each change of the study or its laboratory files.
///
/// After such a change a search uses the evaluations of earlier epochs from the start; those of its own epoch only when
/// it requests them again, so that a resumed run takes the same path.
class Store {
 public:
  /// Opens the store in `file`, or creates it. Existing content is changed only after it has passed all checks. Inputs
  /// that differ from the last ones begin a new epoch, written with the first evaluation. Errors: not a database,
  /// damaged, not a store, other schema version, belongs to another program, in use, not writable.
  static Result<Store> open(const std::filesystem::path& file, const StoreIdentity& identity);

  /// Opens a store of any program and inputs for reading; nothing may be added. Errors: there is no such file, not a
  /// database, damaged, not a store, other schema version.
  static Result<Store> read(const std::filesystem::path& file);

  const StoreIdentity& identity() const;
  int epoch() const;  ///< of evaluations added now
  /// Changes of the inputs since the store was last opened, as paths ("study.parameters.friction"); empty if none.
  const std::vector<std::string>& changes() const;

  /// Losses of the store: rows with a wrong checksum or missing rows; empty if none. Damaged rows are set aside and not
  /// used.
  const std::vector<std::string>& remarks() const;

  std::optional<StoredEvaluation> find(std::string_view key) const;

  /// Stores an evaluation; known keys change nothing. Errors: the disk is full or failed; the evaluation is then not
  /// stored.
  Faults add(const StoredEvaluation& evaluation);

  /// All evaluations, in the order of arrival.
  std::vector<StoredEvaluation> all() const;

  std::size_t size() const;

 private:
  struct State;
  explicit Store(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace pastefit
