#pragma once

#include <cmath>

#include "core/inline.h"

namespace pastefit {

/// a b + c. Packs use the fused instruction, which rounds only once, where the processor has it (core/laws/pack.h);
/// plain doubles round twice, on every processor.
PASTEFIT_INLINE double fused(double a, double b, double c) {
  return a * b + c;
}

/// A vector of three components. Plain struct without alignment, for geometry and for the packed rows of the particles
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

/// s a + b
template <class Real>
PASTEFIT_INLINE BasicVec3<Real> fused(const Real& s, const BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  return {fused(s, a.x, b.x), fused(s, a.y, b.y), fused(s, a.z, b.z)};
}

template <class Real>
PASTEFIT_INLINE Real dot(const BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  return fused(a.z, b.z, fused(a.y, b.y, a.x * b.x));
}

template <class Real>
PASTEFIT_INLINE BasicVec3<Real> cross(const BasicVec3<Real>& a, const BasicVec3<Real>& b) {
  return {fused(a.y, b.z, -(a.z * b.y)), fused(a.z, b.x, -(a.x * b.z)), fused(a.x, b.y, -(a.y * b.x))};
}

PASTEFIT_INLINE Vec3 vector_of(const float (&components)[3]) {
  return {components[0], components[1], components[2]};
}

/// Rounded to single precision.
PASTEFIT_INLINE void put_rounded(const Vec3& v, float (&components)[3]) {
  components[0] = static_cast<float>(v.x);
  components[1] = static_cast<float>(v.y);
  components[2] = static_cast<float>(v.z);
}

PASTEFIT_INLINE double norm(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace pastefit
