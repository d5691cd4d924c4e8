#pragma once

#include <cstddef>
#include <vector>

namespace pastefit {

/// Evidence on one material from simulations on one packing each.
struct Evidence {
  double error = 0;  ///< largest difference of a fitted mean reading from the measurement, over its tolerance
  double noise = 0;  ///< largest standard error of a fitted mean reading, over its tolerance; 0 for a single packing
  int readings = 0;  ///< fitted
  int heaps = 0;     ///< simulated, one on each packing
  int rejected = 0;  ///< of them rejected
  /// Rejection index of each heap, 1 at the limit; unknown ones are left out.
  std::vector<double> rejection_indices = {};
  bool whole = true;  ///< every simulation is complete

  /// Adds a fitted mean reading: its difference from the measurement and its standard error, in its unit.
  void add_reading(double difference, double standard_error, double tolerance);
  /// Adds a heap; NaN: unknown index.
  void add_heap(double rejection_index);
};

/// True if a laboratory would reject a heap of this index.
inline bool is_rejected(double rejection_index) {
  return rejection_index > 1;
}

/// Indices of the accepted heaps; all if all are rejected, so that a reading always has a value. Readings are means
/// over these: a laboratory repeats rejected tests and does not report them.
std::vector<std::size_t> accepted(const std::vector<bool>& rejected);

/// Verdict on the mean of a material over packings that were not used to choose it.
enum class Verdict {
  meets,     ///< within the tolerances
  refuted,   ///< beyond the tolerances despite the noise, or some packing failed or ended early
  undecided  ///< the packings scatter too much
};

/// Verdict on a material, from its error e and noise s; the only place that decides it:
///     meets      e^2 + s^2 <= 1: the error with its standard error added
///     refuted    e^2 - s^2 > 1; the mean of e^2 over packings is that of a mean without noise, plus s^2
///     undecided  otherwise
/// In addition, k of n heaps are rejected, and a share c is accepted. The rejection indices are more informative than
/// the count: their root (`Exceedance`) is taken as normal with unknown mean and deviation, which gives the probability
/// that the share p is at most c by a noncentral t distribution (one-sided tolerance limit: Hahn & Meeker, Statistical
/// Intervals (1991), section 4.6). From the count and a uniform prior, p has a beta distribution of k + 1 and n - k +
/// 1. A material meets only if P(p <= c) >= 0.8 by the indices and >= 0.5 by the count, or >= 0.8 by the count if the
/// indices are unknown (for c = 0.2 none of 8, 1 of 16); it is refuted if P(p <= c) < 0.1 by either (3 of 8).
/// `rejected_share` is c; 1: heaps are not judged. If only one of several heaps is accepted, the scatter is unknown:
/// undecided, unless refuted. Limits: the noise of a single packing is unknown and counts as 0. A material whose true
/// error equals the tolerance meets with probability 0.5 (errors: `calibrate/search/search.h`).
Verdict verdict_on(const Evidence& evidence, double rejected_share);

/// The same for the readings only.
Verdict verdict_on_readings(const Evidence& evidence);

/// Distance of a material from confirmation, 1 at the limit: the larger of its error and its share of rejected heaps
/// over the accepted share. Infinite if some packing failed or ended early.
double shortfall(const Evidence& evidence, double rejected_share);

/// Packings likely to suffice for a verdict, estimated from the present scatter.
double packings_to_decide(const Evidence& evidence);

}  // namespace pastefit
