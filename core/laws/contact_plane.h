#pragma once

#include "core/laws/pack.h"
#include "core/vec3.h"

// What laws with history in the plane of a contact share: how the history turns with the plane, and how it yields.

namespace pastefit::detail {

/// Squared lengths and denominators are kept above the first before they are divided by, contact radii, whose inverse
/// is squared, above the second: far below anything in a scene, and what they divide is still a float.
inline constexpr double kFloor = 1e-30;
inline constexpr double kNoWidth = 1e-15;  // [m]

/// A vector of the contact plane on its way to the plane as it is now: projected, turned with the twist; the length it
/// lost by the projection is given back by `restored`.
template <class Real>
struct Turned {
  BasicVec3<Real> vector;
  Real lost;    ///< squared length lost
  Real square;  ///< squared length left
};

template <class Real>
PASTEFIT_INLINE Turned<Real> turned(const BasicVec3<Real>& a, const BasicVec3<Real>& n, Real twist_angle) {
  const Real along = dot(a, n);
  const BasicVec3<Real> b = fused(-along, n, a);
  return {fused(twist_angle, cross(n, b), b), along * along, larger(dot(b, b), Real(kFloor))};
}

/// sqrt(1 + x) to second order: enough for the few hundredths of a degree a contact turns in a step. Bounded, because
/// the slip of a head-on collision is rounding only, which may lie along the normal as a whole: what is left of it is
/// nothing to be given a length back.
template <class Real>
PASTEFIT_INLINE Real restored(const Turned<Real>& t) {
  return Real(1.0) + Real(0.5) * smaller(t.lost / t.square, Real(1.0));
}

/// The factor that brings a vector down to `limit`; 1 if it is not longer. Where all contacts of a batch hold, as in a
/// heap at rest, there is nothing to divide.
template <class Real>
PASTEFIT_INLINE Real cap(Real square, Real limit) {
  const auto yields = square > limit * limit;
  if (!any(yields)) return Real(1.0);
  return select(yields, limit / square_root(square), Real(1.0));
}

/// The factor that brings a tangential force down to what friction allows, mu (load + normal_force factor^2): the
/// spring's own normal force belongs to the load. Two rounds from below: right to 0.1 % up to mu = 0.5, 4 % low at 1.
/// (From above there is another solution, at which a spring would hold on to a grain that leaves.)
template <class Real>
PASTEFIT_INLINE Real cap(Real square, Real friction, Real load, Real normal_force) {
  const Real one(1.0), least = friction * load;
  if (!any(square > least * least)) return one;
  const Real share = friction / square_root(square);
  Real kept = smaller(share * load, one);
  for (int round = 0; round < 2; ++round) kept = smaller(share * fused(kept * kept, normal_force, load), one);
  return kept;
}

}  // namespace pastefit::detail
