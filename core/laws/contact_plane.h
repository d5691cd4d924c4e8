#pragma once

#include "core/laws/pack.h"
#include "core/vec3.h"

// Shared by laws with a history in the contact plane: rotation of the history with the plane, and its yield.

namespace pastefit::detail {

/// Lower bounds of divisors: of squared lengths and denominators, and of contact radii, whose inverse is squared. Far
/// below any value in a scene, and quotients stay within the range of floats.
inline constexpr double kFloor = 1e-30;
inline constexpr double kNoWidth = 1e-15;  // [m]

/// A vector projected on the present contact plane and rotated by the twist; `restored` corrects the length that the
/// projection took.
template <class Real>
struct Turned {
  BasicVec3<Real> vector;
  Real lost;    ///< squared length removed by the projection
  Real square;  ///< squared length after it
};

template <class Real>
PASTEFIT_INLINE Turned<Real> turned(const BasicVec3<Real>& a, const BasicVec3<Real>& n, Real twist_angle) {
  const Real along = dot(a, n);
  const BasicVec3<Real> b = fused(-along, n, a);
  return {fused(twist_angle, cross(n, b), b), along * along, larger(dot(b, b), Real(kFloor))};
}

/// sqrt(1 + x) to first order, sufficient for the few hundredths of a degree that a contact rotates in a step. Bounded,
/// because the slip of a head-on collision is pure rounding and may lie entirely along the normal; there is no length
/// to restore.
template <class Real>
PASTEFIT_INLINE Real restored(const Turned<Real>& t) {
  return Real(1.0) + Real(0.5) * smaller(t.lost / t.square, Real(1.0));
}

/// Factor that reduces a vector to `limit`; 1 if it is not longer. If all contacts of a batch stick, as in a heap at
/// rest, there is no division.
template <class Real>
PASTEFIT_INLINE Real cap(Real square, Real limit) {
  const auto yields = square > limit * limit;
  if (!any(yields)) return Real(1.0);
  return select(yields, limit / square_root(square), Real(1.0));
}

/// Factor that reduces a tangential force to the friction limit mu (load + normal_force factor^2), which includes the
/// spring's own normal force. Two iterations from below: accurate to 0.1 % up to mu = 0.5, 4 % low at 1. (From above
/// there is another solution, at which a spring would hold a separating grain.)
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
