#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulate.h"

namespace pastefit {

/// What the evaluations of one store have in common. Stored evaluations answer for nothing else.
struct StoreIdentity {
  std::string study;    ///< hash of the study file
  std::string lab;      ///< hash of the laboratory file
  std::string program;  ///< version and engine fingerprint
};

/// One finished simulation, as it is kept.
struct StoredEvaluation {
  std::string key;                 ///< from `evaluation_key`
  std::vector<double> point;       ///< coordinates in the unit cube over the free parameters
  std::vector<double> values;      ///< of every parameter, in the order of `parameter_kinds`
  std::uint64_t packing = 0;       ///< packing seed
  Observables observables;         ///< all readings, measured in the laboratory or not; empty after a failure
  std::optional<Failure> failure;  ///< why there are no readings
  RunSummary run;
  double wall_s = 0;  ///< time the simulation took
};

/// Name of an evaluation: 64-bit FNV-1a over the identity, the exact bits of the values and the packing seed, as 16
/// hexadecimal digits. Two evaluations have the same key if and only if (up to a chance of 2^-64 a pair) the engine
/// would answer both with the same bits.
std::string evaluation_key(const StoreIdentity& identity, std::span<const double> values, std::uint64_t packing);

/// The record of every finished evaluation, an SQLite file in write-ahead mode with full synchronisation.
/// Each evaluation is one transaction: after `add` has returned, it survives the death of the process and of the
/// machine. Safe to use from several threads; for one process at a time.
///
/// Table `evaluations`: sequence (order of arrival), key, point, parameter_values, packing, observables, failure, run;
/// point to run as JSON text with doubles that read back bit for bit. Table `identity`: what the evaluations belong to.
class Store {
 public:
  /// Opens the store in `file`, or creates it. Nothing that stands in the file is changed before it has passed.
  /// Errors: not a database, damaged, not a store, other schema version, belongs to other inputs or to another
  /// program, in use, not writable.
  static Result<Store> open(const std::filesystem::path& file, const StoreIdentity& identity);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  const StoreIdentity& identity() const;

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
