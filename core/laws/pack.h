#pragma once

#include <immintrin.h>

#include <cmath>

#include "core/vec3.h"

namespace pastefit {

/// The compiler's vector of W doubles and the one of its comparisons (a trait, because GCC drops a vector_size that
/// depends on a template parameter).
template <int W>
struct LaneTypes;
#define PASTEFIT_LANES(W)                                       \
  template <>                                                   \
  struct LaneTypes<W> {                                         \
    typedef double Lanes __attribute__((vector_size(8 * W)));   \
    typedef long long Mask __attribute__((vector_size(8 * W))); \
  };
PASTEFIT_LANES(2)
PASTEFIT_LANES(4)
PASTEFIT_LANES(8)
#undef PASTEFIT_LANES

/// W doubles that are computed on together. Only operations that IEEE 754 rounds correctly are offered (+ - * / sqrt,
/// a b + c rounded once, comparisons), so the kernels give the same bits with AVX2 and AVX-512. SSE2 has no `fused` of
/// one rounding: its bits are its own.
template <int W>
struct Pack {
  using Lanes = typename LaneTypes<W>::Lanes;
  using Mask = typename LaneTypes<W>::Mask;
  Lanes v;

  PASTEFIT_INLINE Pack() : v{} {}
  /// The same number in all lanes: s - 0 is s for every s, so that the compiler drops the subtraction.
  PASTEFIT_INLINE Pack(double s) : v(s - Lanes{}) {}
  PASTEFIT_INLINE explicit Pack(Lanes lanes) : v(lanes) {}

  PASTEFIT_INLINE static Pack load(const double* p) { return Pack(*reinterpret_cast<const Lanes*>(p)); }
  PASTEFIT_INLINE void store(double* p) const { *reinterpret_cast<Lanes*>(p) = v; }

  PASTEFIT_INLINE friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  PASTEFIT_INLINE friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  PASTEFIT_INLINE friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  PASTEFIT_INLINE friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  PASTEFIT_INLINE friend Pack operator-(Pack a) { return Pack(-a.v); }
  PASTEFIT_INLINE friend Mask operator<(Pack a, Pack b) { return a.v < b.v; }
  PASTEFIT_INLINE friend Mask operator>(Pack a, Pack b) { return a.v > b.v; }
  PASTEFIT_INLINE friend Mask operator<=(Pack a, Pack b) { return a.v <= b.v; }
  PASTEFIT_INLINE friend Mask operator>=(Pack a, Pack b) { return a.v >= b.v; }
};

template <int W>
PASTEFIT_INLINE Pack<W> select(typename Pack<W>::Mask mask, Pack<W> yes, Pack<W> no) {
  return Pack<W>(mask ? yes.v : no.v);
}

template <int W>
PASTEFIT_INLINE Pack<W> square_root(Pack<W> a) {
#ifdef __AVX512F__
  if constexpr (W == 8) return Pack<W>(_mm512_maskz_sqrt_pd(0xff, a.v));
#endif
#ifdef __AVX__
  if constexpr (W == 4) return Pack<W>(_mm256_sqrt_pd(a.v));
#endif
  if constexpr (W == 2) return Pack<W>(_mm_sqrt_pd(a.v));
}

template <int W>
PASTEFIT_INLINE Pack<W> fused(Pack<W> a, Pack<W> b, Pack<W> c) {
#ifdef __AVX512F__
  if constexpr (W == 8) return Pack<W>(_mm512_fmadd_pd(a.v, b.v, c.v));
#endif
#ifdef __FMA__
  if constexpr (W == 4) return Pack<W>(_mm256_fmadd_pd(a.v, b.v, c.v));
#endif
  if constexpr (W == 2) return a * b + c;
}

template <int W>
PASTEFIT_INLINE Pack<W> larger(Pack<W> a, Pack<W> b) {
  return Pack<W>(a.v > b.v ? a.v : b.v);
}

template <int W>
PASTEFIT_INLINE Pack<W> smaller(Pack<W> a, Pack<W> b) {
  return Pack<W>(a.v < b.v ? a.v : b.v);
}

/// True in some lane.
template <class Mask>
PASTEFIT_INLINE bool any(Mask mask) {
#ifdef __AVX512F__
  if constexpr (sizeof(Mask) == 64) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)) != 0;
#endif
#ifdef __AVX__
  if constexpr (sizeof(Mask) == 32) return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#endif
  if constexpr (sizeof(Mask) == 16) return _mm_movemask_pd(reinterpret_cast<__m128d>(mask)) != 0;
}

// The same vocabulary on plain doubles, so that a law is written once.
PASTEFIT_INLINE double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
PASTEFIT_INLINE bool any(bool mask) {
  return mask;
}
PASTEFIT_INLINE double square_root(double a) {
  return std::sqrt(a);
}
PASTEFIT_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}
PASTEFIT_INLINE double smaller(double a, double b) {
  return a < b ? a : b;
}

}  // namespace pastefit
