#pragma once

#include "core/laws/materials.h"

namespace pastefit {

/// Liquid bridge of two equal spheres in LIGGGHTS' "cohesion easo/capillary/viscous", at contact angle 0 and without
/// viscosity:
///     F = pi gamma R (exp(A gap/R + B) + C),   A = -1.1 v^-0.53, B = 0.48 - 0.0082 ln v, C = 0.078 + 0.0018 ln v,
/// v = V/R^3; it forms at touch and ruptures at the gap V^(1/3). Source: Soulie, Cherblanc, El Youssoufi & Saix, Int.
/// J. Numer. Anal. Meth. Geomech. 30 (2006) 213-228; rupture as in LIGGGHTS-PUBLIC 3.8.0. Only contact angle 0 is used:
/// for others, LIGGGHTS 3.8.0 multiplies two angles instead of averaging them (27 % too strong at 30 degrees).
struct SoulieBridge {
  double radius_m = 0;
  double volume_m3 = 0;
  double surface_tension_n_m = 0;

  double force_n(double gap_m) const;
  double rupture_gap_m() const;
};

/// Difference of two curves, over the peak of the first.
struct CurveDifference {
  double largest = 0, root_mean_square = 0;
  double work = 0;  ///< work of the fitted bridge over that of the card, minus 1
};

struct SoulieFit {
  SoulieBridge bridge;
  CurveDifference difference;
};

/// Fits the bridge to the card's attraction of two grains of mean radius by least squares over 400 gaps up to the
/// larger rupture gap: 200 volumes, each with its optimal tension. Requirement: the contact attracts across a gap.
SoulieFit fit_soulie(const ContactModel& contact, double radius_m);

}  // namespace pastefit
