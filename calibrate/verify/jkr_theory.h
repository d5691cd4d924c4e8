#pragma once

#include "core/rigs/impact/approach.h"

namespace pastefit {

/// The contact of Johnson, Kendall & Roberts (1971) from its own equations, independent of the engine's solution
/// (core/laws/jkr.h): F = 4 E* a^3/(3 R*) - 4 sqrt(pi gamma E*) a^(3/2), d = a^2/R* - sqrt(4 pi gamma a/E*).
/// Requirements: gamma > 0, surface energy of each body [J/m^2].

/// Contact radius at which the contact is torn apart under a given distance [m], and the gap there [m].
double jkr_tear_patch(const Approach& pair, double gamma);
double jkr_tear_gap(const Approach& pair, double gamma);

/// Attraction less repulsion at a gap of at most `jkr_tear_gap` [N]; a negative gap is an overlap.
double jkr_pull(const Approach& pair, double gamma, double gap);

/// Integral of the attraction from touch to the end of the contact [J].
double jkr_work(const Approach& pair, double gamma);

}  // namespace pastefit
