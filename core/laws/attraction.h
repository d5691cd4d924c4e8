#pragma once

#include <cmath>
#include <numbers>
#include <string_view>

#include "core/laws/constants.h"
#include "core/laws/pack.h"

namespace pastefit {

/// Attraction laws: how hard two grains pull on each other across a gap. Each is a type with
///     choice, word   its name in the program and in files;
///     present        false: there is none, and the rest is not needed but for the ends;
///     at_touch, rupture_gap(bridge, radius)   the ends of its range for reference grains: force at d = 0 [N], gap [m];
///     set(pair, bridge, radius, share)   its own constants (those of the ends are there), `share` of its force;
///     at(k, overlap d <= 0, size scale s = 2 R*/R_ref) -> {force [N], |dF/dd| [N/m]};
///     work(k, d, s)   the work [J] that pulls the pair from d to the rupture gap.
/// F/s^2 is a function of d/s, so that grains of other sizes follow the scaling rule of coarse graining.
/// The last two are computed in packs too (laws/pack.h). To add one: core/README.md.

template <class Real>
struct Pull {
  Real force, slope;
};

struct NoAttraction {
  static constexpr BridgeShape choice = BridgeShape::none;
  static constexpr std::string_view word = "none";
  static constexpr bool present = false;
  static double at_touch(const Bridge&, double) { return 0; }
  static double rupture_gap(const Bridge&, double) { return 0; }
  static void set(PairConstants&, const Bridge&, double, double) {}
};

/// What laws have in common whose ends are given: c and d_c.
struct GivenEnds {
  static constexpr bool present = true;
  static double at_touch(const Bridge& bridge, double) { return bridge.c_n; }
  static double rupture_gap(const Bridge& bridge, double) { return -bridge.d_c_m; }
};

/// F = a d^2 + b d + c (Platzer & Fimbinger 2022).
struct PolynomialAttraction : GivenEnds {
  static constexpr BridgeShape choice = BridgeShape::polynomial;
  static constexpr std::string_view word = "polynomial";

  static void set(PairConstants& pair, const Bridge& bridge, double, double share) {
    pair.bridge_a = share * bridge.a_n_m2;
    pair.bridge_b = share * bridge.b_n_m;
  }
  template <class Real>
  PASTEFIT_INLINE static Pull<Real> at(const PairConstants& k, Real d, Real s) {
    const Real slope = fused(Real(k.bridge_a), d, Real(k.bridge_b) * s);
    const Real tangent = fused(Real(k.bridge_a), d, slope);
    return {fused(slope, d, Real(k.bridge_c) * s * s), larger(tangent, -tangent)};
  }
  template <class Real>
  PASTEFIT_INLINE static Real work(const PairConstants& k, Real d, Real s) {
    return antiderivative(k, d, s) - antiderivative(k, Real(-k.rupture_gap) * s, s);
  }

 private:
  template <class Real>
  PASTEFIT_INLINE static Real antiderivative(const PairConstants& k, Real d, Real s) {
    return d * (Real(k.bridge_c) * s * s + d * (Real(0.5 * k.bridge_b) * s + d * Real(k.bridge_a / 3)));
  }
};

/// F = c (1 + d/|d_c|): the polynomial with a = 0.
struct LinearAttraction : PolynomialAttraction {
  static constexpr BridgeShape choice = BridgeShape::linear;
  static constexpr std::string_view word = "linear";

  static void set(PairConstants& pair, const Bridge&, double, double) {
    pair.bridge_b = pair.bridge_c / pair.rupture_gap;
  }
};

/// F = c exp(3 d/|d_c|). The exponent lies in [-3, 0]: the eighth power of a Taylor series of order 11 is exact to
/// 1e-14.
struct ExponentialAttraction : GivenEnds {
  static constexpr BridgeShape choice = BridgeShape::exponential;
  static constexpr std::string_view word = "exponential";

  static void set(PairConstants& pair, const Bridge&, double, double) { pair.bridge_b = 3 / pair.rupture_gap; }
  template <class Real>
  PASTEFIT_INLINE static Pull<Real> at(const PairConstants& k, Real d, Real s) {
    const Real x = larger(Real(k.bridge_b) * d / s, Real(-3.0)) * Real(0.125);
    Real sum(1.0);
    for (int n = 11; n > 0; --n) sum = Real(1.0) + x * Real(1.0 / n) * sum;
    const Real second = sum * sum, fourth = second * second;
    const Real force = Real(k.bridge_c) * s * s * fourth * fourth;
    return {force, force * Real(k.bridge_b) / s};
  }
  template <class Real>
  PASTEFIT_INLINE static Real work(const PairConstants& k, Real d, Real s) {
    return (at(k, d, s).force - at(k, Real(-k.rupture_gap) * s, s).force) * s / Real(k.bridge_b);
  }
};

/// F = c/(1 + 1.05 S + 2.5 S^2), S = gap sqrt(R/V): liquid bridge between equal spheres (Willett et al. 2000, Langmuir
/// 16:9396).
struct CapillaryAttraction {
  static constexpr BridgeShape choice = BridgeShape::capillary;
  static constexpr std::string_view word = "capillary";
  static constexpr bool present = true;

  static double at_touch(const Bridge& bridge, double radius) {
    return 2 * std::numbers::pi * radius * bridge.surface_tension_n_m * std::cos(bridge.contact_angle_rad);
  }
  static double rupture_gap(const Bridge& bridge, double radius) {
    const double root = std::cbrt(bridge.liquid_volume_m3);
    return (1 + 0.5 * bridge.contact_angle_rad) * (root + 0.1 * root * root / radius);
  }
  static void set(PairConstants& pair, const Bridge& bridge, double radius, double) {
    pair.bridge_a = 2.5 * radius / bridge.liquid_volume_m3;
    pair.bridge_b = 1.05 * std::sqrt(radius / bridge.liquid_volume_m3);
  }
  template <class Real>
  PASTEFIT_INLINE static Pull<Real> at(const PairConstants& k, Real d, Real s) {
    const Real gap = -d / s;
    const Real share = Real(1.0) / (Real(1.0) + (Real(k.bridge_b) + Real(k.bridge_a) * gap) * gap);
    const Real force = Real(k.bridge_c) * s * s * share;
    return {force, force * share * (Real(k.bridge_b) + Real(2 * k.bridge_a) * gap) / s};
  }
  /// The integral of 1/(1 + p x + q x^2) has an arc tangent, which packs do not offer; eight-point Gauss-Legendre is
  /// exact to 1e-9 over the length of a bridge.
  template <class Real>
  PASTEFIT_INLINE static Real work(const PairConstants& k, Real d, Real s) {
    constexpr double nodes[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr double weights[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const Real half = Real(0.5) * (d + Real(k.rupture_gap) * s), middle = d - half;
    Real sum(0.0);
    for (int n = 0; n < 4; ++n)
      sum = sum + Real(weights[n]) *
                      (at(k, middle + Real(nodes[n]) * half, s).force + at(k, middle - Real(nodes[n]) * half, s).force);
    return sum * half;
  }
};

/// Attraction of a pair at overlap d, none while it touches; forms and ruptures its bridge (`alive` 0 or 1).
/// A bridge that forms will take work to be pulled apart: the ledger counts that work as spent when it forms (`spent`).
/// Few form in a step, so that the work is computed only where one does.
template <class Attraction, class Real>
PASTEFIT_INLINE Pull<Real> bridge_pull(const PairConstants& k, Real overlap, Real scale, Real& alive, Real& spent) {
  const Real zero(0.0), one(1.0);
  const Real gap = -overlap;
  const Real formed = select(gap <= Real(k.formation_gap) * scale, one, alive);
  const Real before = alive;
  alive = select(gap <= Real(k.rupture_gap) * scale, formed, zero);
  spent = zero;
  if (any(alive > before)) spent = larger(alive - before, zero) * Attraction::work(k, smaller(overlap, zero), scale);
  const Pull<Real> pull = Attraction::at(k, smaller(overlap, zero), scale);
  const Real pulling = select(overlap > zero, zero, alive);
  return {pulling * pull.force, pulling * pull.slope};
}

}  // namespace pastefit
