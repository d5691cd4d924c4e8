#pragma once

#include "core/laws/materials.h"

namespace pastefit {

/// The liquid bridge of two equal spheres by which LIGGGHTS's "cohesion easo/capillary/viscous" attracts, at contact
/// angle 0 and without viscosity:
///     F = pi gamma R (exp(A gap/R + B) + C),   A = -1.1 v^-0.53, B = 0.48 - 0.0082 ln v, C = 0.078 + 0.0018 ln v,
/// v = V/R^3; it forms at touch and ruptures at the gap V^(1/3).
/// Source: Soulie, Cherblanc, El Youssoufi & Saix, Int. J. Numer. Anal. Meth. Geomech. 30 (2006) 213-228; rupture as
/// LIGGGHTS-PUBLIC 3.8.0 has it. At other contact angles LIGGGHTS 3.8.0 multiplies two angles where it should average
/// them (27 % too strong at 30 degrees); at 0 it is right, and 0 is what is used here.
struct SoulieBridge {
  double radius_m = 0;
  double volume_m3 = 0;
  double surface_tension_n_m = 0;

  double force_n(double gap_m) const;
  double rupture_gap_m() const;
};

/// How far one curve is from another, over the peak of the first.
struct CurveDifference {
  double largest = 0, root_mean_square = 0;
  double work = 0;  ///< work of the fitted bridge over that of the card's, less 1
};

struct SoulieFit {
  SoulieBridge bridge;
  CurveDifference difference;
};

/// The bridge whose curve is nearest to the card's attraction between two grains of the mean radius, in the sense of
/// least squares over 400 gaps up to the farther of both ruptures: the tension follows for each of 200 volumes.
/// Requirement: the contact attracts across a gap.
SoulieFit fit_soulie(const ContactModel& contact, double radius_m);

}  // namespace pastefit
