#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/laws/normal.h"

namespace pastefit {

/// Elasto-plastic adhesion (Luding, Granular Matter 10 (2008) 235; Thakur et al., Granular Matter 16 (2014) 383, doi
/// 10.1007/s10035-014-0506-4: the Edinburgh model, EEPA). Exponent m: 3/2 for `epa`, 1 for `luding`; plasticity ratio
/// l, adhesion ratio x = k_c/k_1, constant pull-off f0:
///     k1 = 4/3 E* R*^(2-m),   k2 = k1/(1 - l);
///     loading                F = k1 d^m - f0
///     unloading, reloading   F = k2 (d^m - p^m) - f0,   p the plastic overlap, p^m = l d_max^m
///     adhesion               F = -x k1 d^m - f0, the lower limit of F.
///
///     F |           //       loading: k1 d^m
///       |         / /
///       |       /  /         unloading, reloading: k2 (d^m - p^m)
///       |     /   /
///       |   /    /
///       | /     /
///     --+------p------ d
///       | \   /
///       |   \/               adhesion: -x k1 d^m     (f0 = 0)
///
/// All three are the second line with a plastic overlap that yields: p is kept between l^(1/m) d, the loading line, and
/// (1 + x (1 - l))^(1/m) d, the adhesion branch. So p shrinks on that branch, reloading is parallel to unloading, and p
/// is forgotten when the contact opens. A contact that exists when the law takes over, as after the filling of a mould,
/// is at its deepest overlap so far.
///
/// f0 is `PairConstants::cohesion`. Friction uses F + f0 + x k1 d^m (Thakur et al. 2014). S_n = 2 E* a, with a =
/// sqrt(R* d) for `epa` as for Hertz, and a = 2/3 R* for `luding`, whose stiffness k1 and dashpots are constant.
/// Scale-free: l and x unchanged, f0 over the squared mean radius. A wall yields as grains do; its share of the
/// attraction applies to x and f0.
template <NormalLaw law>
struct ElastoPlasticAdhesion {
  static constexpr NormalLaw choice = law;
  static constexpr bool is_linear = law == NormalLaw::luding;
  static constexpr std::string_view word = is_linear ? "luding" : "epa";
  static constexpr std::array<std::string_view, 4> parameters{"plasticity_ratio", "adhesion_ratio", "pull_off_pa",
                                                              "cohesion_factor"};
  static constexpr bool adheres = false, reaches = false, yields = true, beside_bridges = false;

  template <class Value>
  static void make(ContactModel& contact, double radius, const Value& value) {
    contact.plasticity_ratio = value("plasticity_ratio");
    contact.adhesion_ratio = value("adhesion_ratio");
    contact.cohesion_n = value("pull_off_pa") * radius * radius;
  }
  static void set(PairConstants& pair, const ContactModel& grains, double share) {
    pair.adhesion = share * grains.adhesion_ratio;
    pair.stiffening = 1 / (1 - grains.plasticity_ratio);
    pair.least_plastic = root(grains.plasticity_ratio);
    pair.most_plastic = root(1 + pair.adhesion * (1 - grains.plasticity_ratio));
  }

  template <class Real>
  PASTEFIT_INLINE static NormalForce<Real> at(const ConstantsOf<Real>& k, Real sqrt_radius, Real overlap,
                                              Real plastic) {
    const Real zero(0.0), depth = larger(overlap, zero), radius = sqrt_radius * sqrt_radius;
    const auto touching = overlap > zero;
    const Real yielded = smaller(larger(plastic, k.least_plastic * depth), k.most_plastic * depth);
    const Real first = loading_stiffness(k, sqrt_radius), deep = power(depth);
    const Real scale = k.size_per_radius * radius, most = k.adhesion * first * deep;
    NormalForce<Real> normal;
    normal.touching = touching;
    normal.contact_radius =
        is_linear ? select(touching, Real(2.0 / 3) * radius, zero) : sqrt_radius * square_root(depth);
    normal.force = k.stiffening * first * (deep - power(yielded));
    normal.load = larger(normal.force + most, zero);
    normal.reserve = select(touching, fused(k.cohesion, scale * scale, most), zero);
    normal.plastic = yielded;
    return normal;
  }
  /// Energy of the spring k2, deformed from p: m k2 ((d^(m+1)/m + p^(m+1))/(m + 1) - d p^m/m).
  template <class Real>
  PASTEFIT_INLINE static Real energy(const ConstantsOf<Real>& k, Real radius, const NormalForce<Real>& normal_force,
                                     Real overlap) {
    const Real d = larger(overlap, Real(0.0)), p = normal_force.plastic;
    const Real spring = Real(1 / (m + 1)) * d * power(d) + Real(m / (m + 1)) * p * power(p) - d * power(p);
    return k.stiffening * loading_stiffness(k, square_root(radius)) * spring;
  }
  template <class Real>
  PASTEFIT_INLINE static Real yielded(const ConstantsOf<Real>& k, Real radius, Real before, Real after, Real middle) {
    const Real spring =
        Real(m / (m + 1)) * (before * power(before) - after * power(after)) - middle * (power(before) - power(after));
    return k.stiffening * loading_stiffness(k, square_root(radius)) * spring;
  }
  template <class Real>
  PASTEFIT_INLINE static Real widening(const ConstantsOf<Real>& k, Real radius, Real energy,
                                       Real inverse_contact_radius) {
    if constexpr (is_linear) return Real(0.0);
    return Hertz::widening(k, radius, energy, inverse_contact_radius);
  }
  static double overlap_under(const PairConstants& k, double radius, double load) {
    return root(load / loading_stiffness(k, std::sqrt(radius)));
  }
  /// Of a collision along the stiffer line.
  static double collision_time(const PairConstants& k, double radius, double mass, double speed) {
    if constexpr (is_linear)
      return std::numbers::pi * std::sqrt(mass / (k.stiffening * loading_stiffness(k, std::sqrt(radius))));
    return Hertz::collision_time(k, radius, mass, speed) / std::pow(k.stiffening, 0.4);
  }

 private:
  static constexpr double m = is_linear ? 1 : 1.5;

  template <class Real>
  PASTEFIT_INLINE static Real power(Real d) {
    if constexpr (is_linear) return d;
    return d * square_root(d);
  }
  static double root(double power) { return std::pow(power, 1 / m); }
  template <class Real>
  PASTEFIT_INLINE static Real loading_stiffness(const ConstantsOf<Real>& k, Real sqrt_radius) {
    return k.hertz * (is_linear ? sqrt_radius * sqrt_radius : sqrt_radius);
  }
};

using Epa = ElastoPlasticAdhesion<NormalLaw::epa>;
using Luding = ElastoPlasticAdhesion<NormalLaw::luding>;

}  // namespace pastefit
