#pragma once

#include "calibrate/search/objective.h"

namespace pastefit {

/// What the mean of a candidate over fresh packings says of it.
enum class Verdict {
  holds,     ///< it meets the laboratory
  refuted,   ///< it misses the laboratory by more than the tolerances, noise or not; or some packing failed
  undecided  ///< the packings scatter too much to tell
};

/// Judges a candidate by its answer on packings it was not chosen on. By what it misses the laboratory, m
/// tolerances (`Response::normalised_error`), and the part s of it that the noise of the packings makes by itself
/// (`noise`):
///     holds      m^2 + s^2 <= 1: what it may truly miss, its error included
///     refuted    m^2 - s^2 > 1; the mean of m^2 over fillings is that of a mean without noise, plus s^2
///     undecided  otherwise
/// Besides, a laboratory would reject k of the n heaps, and a share c of them may be rejected. How near each heap came
/// to being rejected tells more than how many were: its root (`Exceedance`) is taken as normal with unknown mean and
/// deviation, which gives the probability that the share p is no larger by a noncentral t distribution (a one-sided
/// tolerance limit: Hahn & Meeker, Statistical Intervals (1991), section 4.6). By count p has, with an even prior, a
/// beta distribution of k + 1 and n - k + 1. It holds only with P(p <= c) >= 0.8 by how near they came and >= 0.5 by
/// count, or >= 0.8 by count where it is not known how near they came (for c = 0.2 none of 8, 1 of 16); it is refuted
/// with P(p <= c) < 0.1 by either (3 of 8).
/// Where only one of several heaps is left, the scatter is not known: undecided, unless it is refuted.
/// Limit: of a single packing the noise is not known and counts as none.
Verdict verdict_on(const Response& response, double rejected_share = 1);

/// The same by the numbers.
Verdict verdict_on(double normalised_error, double noise);

/// How far a candidate is from being confirmed, 1 at the limit: what it misses the laboratory by, in tolerances, or the
/// share of its heaps that a laboratory would reject over the share that may be, whichever is more. Infinite if some
/// packing failed or ended early.
double shortfall(const Response& response, double rejected_share);

/// Packings of which the mean is likely to be known well enough to be judged, by the scatter of those that there are.
double packings_to_decide(const Response& response);

}  // namespace pastefit
