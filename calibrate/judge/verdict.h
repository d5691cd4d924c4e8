#pragma once

#include <cstddef>
#include <vector>

namespace pastefit {

/// What the simulations of one material, each on a packing of its own, say of it.
struct Evidence {
  double error = 0;  ///< largest difference of a fitted mean reading from the laboratory, over its tolerance
  double noise = 0;  ///< largest standard error of a fitted mean reading, over its tolerance; 0: of a single packing
  int readings = 0;  ///< that are fitted
  int heaps = 0;     ///< simulated, one on each packing
  int rejected = 0;  ///< of them, that a laboratory would reject
  /// How near each came to being rejected, 1 at the limit; those of which it is not known are left out.
  std::vector<double> rejection_indices = {};
  bool whole = true;  ///< every simulation ran to its end

  /// Counts a mean reading that is fitted: its difference from the laboratory and its standard error, both in its unit.
  void add_reading(double difference, double standard_error, double tolerance);
  /// Counts a heap; NaN: it is not known how near it came.
  void add_heap(double rejection_index);
};

/// Whether a heap of this index is one that a laboratory would reject.
inline bool is_rejected(double rejection_index) {
  return rejection_index > 1;
}

/// Of heaps some of which a laboratory would reject: those that it would accept, as indices; all of them, if it would
/// reject every one, so that a reading is never without a number. Readings are means over these: a laboratory repeats
/// the others and does not report them.
std::vector<std::size_t> accepted(const std::vector<bool>& rejected);

/// What the mean of a material over packings on which it was not chosen says of it.
enum class Verdict {
  meets,     ///< it meets the laboratory
  refuted,   ///< it misses the laboratory by more than the tolerances, noise or not; or some packing failed
  undecided  ///< the packings scatter too much to tell
};

/// Whether a material meets the laboratory: the only place that decides it. By its error e and noise s:
///     meets      e^2 + s^2 <= 1: what it may truly miss, its standard error included
///     refuted    e^2 - s^2 > 1; the mean of e^2 over packings is that of a mean without noise, plus s^2
///     undecided  otherwise
/// Besides, a laboratory would reject k of the n heaps, and a share c of them may be rejected. How near each heap came
/// to being rejected tells more than how many were: its root (`Exceedance`) is taken as normal with unknown mean and
/// deviation, which gives the probability that the share p is no larger by a noncentral t distribution (a one-sided
/// tolerance limit: Hahn & Meeker, Statistical Intervals (1991), section 4.6). By count p has, with an even prior, a
/// beta distribution of k + 1 and n - k + 1. It meets only with P(p <= c) >= 0.8 by how near they came and >= 0.5 by
/// count, or >= 0.8 by count where it is not known how near they came (for c = 0.2 none of 8, 1 of 16); it is refuted
/// with P(p <= c) < 0.1 by either (3 of 8). `rejected_share` is c; 1: heaps are not judged.
/// Where only one of several heaps is left, the scatter is not known: undecided, unless it is refuted.
/// Limits: of a single packing the noise is not known and counts as none. A material that truly misses by just its
/// tolerance meets the laboratory half of the time (`calibrate/search/strategy.h` says more of errors).
Verdict verdict_on(const Evidence& evidence, double rejected_share);

/// The same of the readings alone.
Verdict verdict_on_readings(const Evidence& evidence);

/// How far a material is from being confirmed, 1 at the limit: its error, or the share of its heaps that a laboratory
/// would reject over the share that may be, whichever is more. Infinite if some packing failed or ended early.
double shortfall(const Evidence& evidence, double rejected_share);

/// Packings of which the mean is likely to be known well enough to be judged, by the scatter of those that there are.
double packings_to_decide(const Evidence& evidence);

}  // namespace pastefit
