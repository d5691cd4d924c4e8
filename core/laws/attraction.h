#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/laws/constants.h"
#include "core/laws/pack.h"

namespace pastefit {

/// Attraction laws: force of two grains on each other across a gap. Each is a type with
///     choice, word   its name in the program and in files;
///     parameters     names of its scale-free parameters; each surface has its own `cohesion_factor`;
///     make(contact, radius, value)   sets its constants for grains of this mean radius from `value(name)`;
///     present        false: no attraction; only the ends are needed;
///     at_touch, rupture_gap(bridge, radius)   ends of its range for reference grains: force at d = 0 [N], gap [m];
///     set(pair, bridge, radius, share)   its constants of a pair (those of the ends are set), `share` of its force;
///     at(k, overlap d <= 0, size scale s = 2 R*/R_ref) -> {force [N], |dF/dd| [N/m]};
///     work(k, d, s)   work [J] to separate the pair from d to the rupture gap.
/// F/s^2 is a function of d/s, so that other grain sizes follow coarse graining.
/// The last two are computed in packs too (laws/pack.h). To add one: core/README.md.

template <class Real>
struct Pull {
  Real force, slope;
};

struct NoAttraction {
  static constexpr BridgeShape choice = BridgeShape::none;
  static constexpr std::string_view word = "none";
  static constexpr std::array<std::string_view, 0> parameters{};
  static constexpr bool present = false;
  template <class Value>
  static void make(ContactModel& contact, double, const Value&) {
    contact.bridge = {.shape = choice, .formation = contact.bridge.formation};
    contact.cohesion_n = 0;
  }
  static double at_touch(const Bridge&, double) { return 0; }
  static double rupture_gap(const Bridge&, double) { return 0; }
  static void set(PairConstants&, const Bridge&, double, double) {}
};

/// Parameters of all attractions: c/R^2, -d_c/R, 2 offset/-d_c, the cohesion over c, and the viscosity. The liquid
/// shells of two grains meet at a gap of twice the offset; beyond the rupture gap this has no effect. With touch
/// formation there is no formation_ratio: the shells then reach as far as the bridge.
struct AcrossGap {
  static constexpr std::array<std::string_view, 6> parameters{"strength_pa",    "rupture_gap_ratio", "formation_ratio",
                                                              "cohesion_ratio", "cohesion_factor",   "viscosity_pa_s"};
  static constexpr std::string_view film_parameter = "formation_ratio";
  static constexpr bool present = true;

 protected:
  struct Ends {
    double at_touch_n, rupture_gap_m;
  };
  /// Starts the bridge anew: keeps its formation and sets its offset.
  template <class Value>
  static Ends begin(ContactModel& contact, BridgeShape shape, double radius, const Value& value) {
    const BridgeFormation formation = contact.bridge.formation;
    const double c = value("strength_pa") * radius * radius;
    const double gap = value("rupture_gap_ratio") * radius;
    const double reach = formation == BridgeFormation::film ? value(film_parameter) : 1;
    contact.bridge = {.shape = shape,
                      .formation = formation,
                      .offset_m = 0.5 * reach * gap,
                      .viscosity_pa_s = value("viscosity_pa_s")};
    contact.cohesion_n = value("cohesion_ratio") * c;
    return {c, gap};
  }
};

/// Laws that are given by their ends c and d_c.
struct GivenEnds : AcrossGap {
  static double at_touch(const Bridge& bridge, double) { return bridge.c_n; }
  static double rupture_gap(const Bridge& bridge, double) { return -bridge.d_c_m; }

 protected:
  template <class Value>
  static void begin(ContactModel& contact, BridgeShape shape, double radius, const Value& value) {
    const Ends ends = AcrossGap::begin(contact, shape, radius, value);
    contact.bridge.c_n = ends.at_touch_n;
    contact.bridge.d_c_m = -ends.rupture_gap_m;
  }
};

/// F = a d^2 + b d + c (Platzer & Fimbinger 2022). Scale-free, with s = d/d_c, f = F(d_c)/c the rupture_force_ratio and
/// k the curvature, -1 (flat at touch) .. 0 (straight) .. 1 (flat at rupture): F/c = 1 - (1 - f)[(1 + k) s - k s^2].
struct PolynomialAttraction : GivenEnds {
  static constexpr BridgeShape choice = BridgeShape::polynomial;
  static constexpr std::string_view word = "polynomial";
  static constexpr std::array<std::string_view, 8> parameters{
      "strength_pa",     "rupture_gap_ratio", "formation_ratio",     "cohesion_ratio",
      "cohesion_factor", "viscosity_pa_s",    "rupture_force_ratio", "curvature"};

  template <class Value>
  static void make(ContactModel& contact, double radius, const Value& value) {
    begin(contact, choice, radius, value);
    Bridge& bridge = contact.bridge;
    const double k = value("curvature"), c = bridge.c_n, d_c = bridge.d_c_m;
    const double lost = 1 - value("rupture_force_ratio");  // share of the attraction lost at rupture
    bridge.a_n_m2 = k * lost * c / (d_c * d_c);
    bridge.b_n_m = lost * (1 + k) * c / -d_c;
  }
  static void set(PairConstants& pair, const Bridge& bridge, double, double share) {
    pair.bridge_a = share * bridge.a_n_m2;
    pair.bridge_b = share * bridge.b_n_m;
  }
  template <class Real>
  PASTEFIT_INLINE static Pull<Real> at(const ConstantsOf<Real>& k, Real d, Real s) {
    const Real slope = fused(k.bridge_a, d, k.bridge_b * s);
    const Real tangent = fused(k.bridge_a, d, slope);
    return {fused(slope, d, k.bridge_c * s * s), larger(tangent, -tangent)};
  }
  template <class Real>
  PASTEFIT_INLINE static Real work(const ConstantsOf<Real>& k, Real d, Real s) {
    return antiderivative(k, d, s) - antiderivative(k, -k.rupture_gap * s, s);
  }

 private:
  template <class Real>
  PASTEFIT_INLINE static Real antiderivative(const ConstantsOf<Real>& k, Real d, Real s) {
    return d * (k.bridge_c * s * s + d * (Real(0.5) * k.bridge_b * s + d * Real(1.0 / 3) * k.bridge_a));
  }
};

/// F = c (1 + d/|d_c|): the polynomial with a = 0.
struct LinearAttraction : PolynomialAttraction {
  static constexpr BridgeShape choice = BridgeShape::linear;
  static constexpr std::string_view word = "linear";
  static constexpr auto parameters = AcrossGap::parameters;

  template <class Value>
  static void make(ContactModel& contact, double radius, const Value& value) {
    begin(contact, choice, radius, value);
  }
  static void set(PairConstants& pair, const Bridge&, double, double) {
    pair.bridge_b = pair.bridge_c / pair.rupture_gap;
  }
};

/// F = c exp(3 d/|d_c|). The exponent is in [-3, 0]: the eighth power of a Taylor series of order 11 is accurate to
/// 1e-14.
struct ExponentialAttraction : GivenEnds {
  static constexpr BridgeShape choice = BridgeShape::exponential;
  static constexpr std::string_view word = "exponential";

  template <class Value>
  static void make(ContactModel& contact, double radius, const Value& value) {
    begin(contact, choice, radius, value);
  }
  static void set(PairConstants& pair, const Bridge&, double, double) { pair.bridge_b = 3 / pair.rupture_gap; }
  template <class Real>
  PASTEFIT_INLINE static Pull<Real> at(const ConstantsOf<Real>& k, Real d, Real s) {
    const Real x = larger(k.bridge_b * d / s, Real(-3.0)) * Real(0.125);
    Real sum(1.0);
    for (int n = 11; n > 0; --n) sum = Real(1.0) + x * Real(1.0 / n) * sum;
    const Real second = sum * sum, fourth = second * second;
    const Real force = k.bridge_c * s * s * fourth * fourth;
    return {force, force * k.bridge_b / s};
  }
  template <class Real>
  PASTEFIT_INLINE static Real work(const ConstantsOf<Real>& k, Real d, Real s) {
    return (at(k, d, s).force - at(k, -k.rupture_gap * s, s).force) * s / k.bridge_b;
  }
};

/// F = c/(1 + 1.05 S + 2.5 S^2), S = gap sqrt(R/V): liquid bridge between equal spheres (Willett et al. 2000, Langmuir
/// 16:9396). Scale-free: perfectly wetting; surface tension and volume follow from c and d_c.
struct CapillaryAttraction : AcrossGap {
  static constexpr BridgeShape choice = BridgeShape::capillary;
  static constexpr std::string_view word = "capillary";

  template <class Value>
  static void make(ContactModel& contact, double radius, const Value& value) {
    const auto [c, gap] = begin(contact, choice, radius, value);
    contact.bridge.surface_tension_n_m = c / (2 * std::numbers::pi * radius);
    const double root = 2 * gap / (1 + std::sqrt(1 + 0.4 * gap / radius));  // solves gap = root + 0.1 root^2/R
    contact.bridge.liquid_volume_m3 = root * root * root;
  }
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
  PASTEFIT_INLINE static Pull<Real> at(const ConstantsOf<Real>& k, Real d, Real s) {
    const Real gap = -d / s;
    const Real share = Real(1.0) / (Real(1.0) + (k.bridge_b + k.bridge_a * gap) * gap);
    const Real force = k.bridge_c * s * s * share;
    return {force, force * share * (k.bridge_b + Real(2.0) * k.bridge_a * gap) / s};
  }
  /// The integral of 1/(1 + p x + q x^2) needs an arc tangent, which packs do not have; eight-point Gauss-Legendre is
  /// accurate to 1e-9 over the length of a bridge.
  template <class Real>
  PASTEFIT_INLINE static Real work(const ConstantsOf<Real>& k, Real d, Real s) {
    constexpr double nodes[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr double weights[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const Real half = Real(0.5) * (d + k.rupture_gap * s), middle = d - half;
    Real sum(0.0);
    for (int n = 0; n < 4; ++n)
      sum = sum + Real(weights[n]) *
                      (at(k, middle + Real(nodes[n]) * half, s).force + at(k, middle - Real(nodes[n]) * half, s).force);
    return sum * half;
  }
};

/// Attraction of a pair at overlap d, zero in contact; forms and ruptures its bridge (`alive` 0 or 1). The energy
/// balance counts the work of separating a bridge as dissipated when it forms (`spent`). Few form in a step, so it is
/// computed only where one does.
template <class Attraction, class Real>
PASTEFIT_INLINE Pull<Real> bridge_pull(const ConstantsOf<Real>& k, Real overlap, Real scale, Real& alive, Real& spent) {
  const Real zero(0.0), one(1.0);
  const Real gap = -overlap;
  const Real formed = select(gap <= k.formation_gap * scale, one, alive);
  const Real before = alive;
  alive = select(gap <= k.rupture_gap * scale, formed, zero);
  spent = zero;
  if (any(alive > before)) spent = larger(alive - before, zero) * Attraction::work(k, smaller(overlap, zero), scale);
  const Pull<Real> pull = Attraction::at(k, smaller(overlap, zero), scale);
  const Real pulling = select(overlap > zero, zero, alive);
  return {pulling * pull.force, pulling * pull.slope};
}

}  // namespace pastefit
