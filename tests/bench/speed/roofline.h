#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pastefit {

/// What a machine can do, measured on one core.
struct MachineLimits {
  double triad_gb_s = 0;        ///< a = b + s c over arrays far beyond any cache; three columns counted
  double gflop_s = 0;           ///< additions and multiplications, not fused: what our kernels may use
  double roots_gop_s = 0;       ///< square roots and divisions in the kernels' ratio of 5 to 3
  int lanes = 0;                ///< floats in a vector of the kernels of this processor
  std::string instruction_set;  ///< of these kernels
};
MachineLimits measure_machine();

/// What one listed contact takes: counted by running the law on numbers that count.
struct ContactCost {
  int additions_multiplications = 0;  ///< comparisons and selections counted as such
  int roots_divisions = 0;
  double bytes_streamed = 0;  ///< columns of the contact, read and written once
  double bytes_gathered = 0;  ///< its two grains and their loads; mostly found in a cache
};
ContactCost cost_of_contact(bool cohesive);

/// A scene against the limits.
struct Roofline {
  MachineLimits machine;
  ContactCost cost;
  std::string scene;
  double contact_ns = 0;     ///< measured: all of a step, over the contacts worked on
  double memory_ns = 0;      ///< streamed bytes at the triad's speed
  double arithmetic_ns = 0;  ///< additions and multiplications at their peak
  double roots_ns = 0;       ///< square roots and divisions at their peak
  /// The slowest of the three limits over what is measured; they may overlap, so it can reach 1, and nothing can pass.
  double share_of_limit() const;
};

/// The box of 100,000 grains against this machine.
Roofline measure_roofline();

std::string table_of(const Roofline& roofline);
nlohmann::ordered_json json_of(const Roofline& roofline);

}  // namespace pastefit
