#pragma once

#include <immintrin.h>

#include <cmath>

#include "core/inline.h"

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

/// W doubles that are computed on together. Each lane gets the bits that plain doubles would: only operations that
/// IEEE 754 rounds correctly are offered (+ - * / sqrt, comparisons), so the kernels give the same result on every
/// instruction set.
template <int W>
struct Pack {
  using Lanes = typename LaneTypes<W>::Lanes;
  using Mask = typename LaneTypes<W>::Mask;
  Lanes v;

  PASTEFIT_INLINE Pack() : v{} {}
  PASTEFIT_INLINE Pack(double s) : v(Lanes{} + s) {}
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
PASTEFIT_INLINE Pack<W> larger(Pack<W> a, Pack<W> b) {
  return Pack<W>(a.v > b.v ? a.v : b.v);
}

template <int W>
PASTEFIT_INLINE Pack<W> smaller(Pack<W> a, Pack<W> b) {
  return Pack<W>(a.v < b.v ? a.v : b.v);
}

// The same vocabulary on plain doubles, so that a law is written once.
PASTEFIT_INLINE double select(bool mask, double yes, double no) {
  return mask ? yes : no;
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
