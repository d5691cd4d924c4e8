#pragma once

#include <cmath>

#include "core/inline.h"

namespace pastefit {

/// A vector of three components. Plain struct, no alignment: cold geometry and the packed rows of the particles use it
/// alike.
template <class Real>
struct BasicVec3 {
  Real x{}, y{}, z{};
};

using Vec3 = BasicVec3<double>;

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> operator+(const BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> operator-(const BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> operator-(const BasicVec3<Real>& a) {
  return {-a.x, -a.y, -a.z};
}

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> operator*(const Real& s, const BasicVec3<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class Real>
PASTEFIT_INLINE BasicVec3<Real>& operator+=(BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  a = a + b;
  return a;
}

template <class Real>
PASTEFIT_INLINE Real dot(const BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> cross(const BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

PASTEFIT_INLINE double norm(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace pastefit
