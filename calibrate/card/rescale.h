#pragma once

#include "calibrate/card/card.h"

namespace pastefit {

/// The card's material for grains of another mean radius, in all its tests, by the scaling rule: F/R^2 stays the same
/// function of d/R. With s = radius/old radius of the material's grains: a stays, b s, c s^2, d_c s, offset s, cohesion
/// s^2, liquid volume s^3, surface tension s, all radii of the distribution s; Young's modulus stays (contact stiffness
/// then goes with s). Source: Thakur, Ooi & Ahmadian, Powder Technology 293 (2016) 130-137.
///
/// What was simulated with the old grains (readings, confirmations, baseline, rebaselining) does not hold for the new
/// ones and is left out; `rescaled` gets a row without bias (`check/rescale_bias.h` measures it).
/// Errors: grains that a test cannot be run with (too coarse for the mould, finer than the format allows).
Result<Card> rescaled(Card card, double radius_m);

}  // namespace pastefit
