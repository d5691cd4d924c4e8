#pragma once

#include <cmath>
#include <cstdint>

#include "core/target.h"
#include "core/vec3.h"

namespace pastefit {

/// The compiler's vector of W numbers and the one of its comparisons (a trait, because GCC drops a vector_size that
/// depends on a template parameter).
template <class Number, int W>
struct LaneTypes;
#define PASTEFIT_LANES(NUMBER, TRUTH, W)                                     \
  template <>                                                                \
  struct LaneTypes<NUMBER, W> {                                              \
    typedef NUMBER Lanes __attribute__((vector_size(sizeof(NUMBER) * (W)))); \
    typedef TRUTH Mask __attribute__((vector_size(sizeof(NUMBER) * (W))));   \
  };
PASTEFIT_LANES(double, long long, 2)
PASTEFIT_LANES(double, long long, 4)
PASTEFIT_LANES(double, long long, 8)
PASTEFIT_LANES(float, int, 2)
PASTEFIT_LANES(float, int, 4)
PASTEFIT_LANES(float, int, 8)
PASTEFIT_LANES(float, int, 16)
#undef PASTEFIT_LANES

/// W numbers that are computed on together. Only operations that IEEE 754 rounds correctly are offered (+ - * / sqrt,
/// a b + c rounded once, comparisons). Packs of 16 bytes round `fused` twice, because SSE2 and WebAssembly cannot do it
/// otherwise: their bits differ from those of wider packs, and are the same on every type of processor.
template <class Number, int W>
struct Pack {
  using Lanes = typename LaneTypes<Number, W>::Lanes;
  using Mask = typename LaneTypes<Number, W>::Mask;
  Lanes v;

  PASTEFIT_INLINE Pack() : v{} {}
  /// The same number in all lanes: s - 0 is s for every s, so that the compiler drops the subtraction.
  PASTEFIT_INLINE Pack(double s) : v(static_cast<Number>(s) - Lanes{}) {}
  PASTEFIT_INLINE explicit Pack(Lanes lanes) : v(lanes) {}

  PASTEFIT_INLINE static Pack load(const Number* p) { return Pack(*reinterpret_cast<const Lanes*>(p)); }
  PASTEFIT_INLINE void store(Number* p) const { *reinterpret_cast<Lanes*>(p) = v; }

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
using Doubles = Pack<double, W>;
template <int W>
using Singles = Pack<float, W>;

template <class Number, int W>
PASTEFIT_INLINE Pack<Number, W> select(typename Pack<Number, W>::Mask mask, Pack<Number, W> yes, Pack<Number, W> no) {
  return Pack<Number, W>(mask ? yes.v : no.v);
}

template <class Number, int W>
PASTEFIT_INLINE Pack<Number, W> square_root(Pack<Number, W> a) {
#ifdef __AVX512F__
  if constexpr (sizeof(a) == 64 && sizeof(Number) == 8) return Pack<Number, W>(_mm512_sqrt_pd(a.v));
  if constexpr (sizeof(a) == 64 && sizeof(Number) == 4) return Pack<Number, W>(_mm512_sqrt_ps(a.v));
#endif
#ifdef __AVX__
  if constexpr (sizeof(a) == 32 && sizeof(Number) == 8) return Pack<Number, W>(_mm256_sqrt_pd(a.v));
  if constexpr (sizeof(a) == 32 && sizeof(Number) == 4) return Pack<Number, W>(_mm256_sqrt_ps(a.v));
#endif
#if PASTEFIT_X86
  if constexpr (sizeof(a) == 16 && sizeof(Number) == 8) return Pack<Number, W>(_mm_sqrt_pd(a.v));
  if constexpr (sizeof(a) == 16 && sizeof(Number) == 4) return Pack<Number, W>(_mm_sqrt_ps(a.v));
#elif PASTEFIT_SIMD128
  using Lanes = typename Pack<Number, W>::Lanes;
  if constexpr (sizeof(Number) == 8) return Pack<Number, W>((Lanes)wasm_f64x2_sqrt((v128_t)a.v));
  if constexpr (sizeof(Number) == 4) return Pack<Number, W>((Lanes)wasm_f32x4_sqrt((v128_t)a.v));
#else
  for (int lane = 0; lane < W; ++lane) a.v[lane] = std::sqrt(a.v[lane]);  // one instruction, with optimisation
  return a;
#endif
}

template <class Number, int W>
PASTEFIT_INLINE Pack<Number, W> fused(Pack<Number, W> a, Pack<Number, W> b, Pack<Number, W> c) {
#ifdef __AVX512F__
  if constexpr (sizeof(a) == 64 && sizeof(Number) == 8) return Pack<Number, W>(_mm512_fmadd_pd(a.v, b.v, c.v));
  if constexpr (sizeof(a) == 64 && sizeof(Number) == 4) return Pack<Number, W>(_mm512_fmadd_ps(a.v, b.v, c.v));
#endif
#ifdef __FMA__
  if constexpr (sizeof(a) == 32 && sizeof(Number) == 8) return Pack<Number, W>(_mm256_fmadd_pd(a.v, b.v, c.v));
  if constexpr (sizeof(a) == 32 && sizeof(Number) == 4) return Pack<Number, W>(_mm256_fmadd_ps(a.v, b.v, c.v));
#endif
  if constexpr (sizeof(a) == 16) return a * b + c;
}

template <class Number, int W>
PASTEFIT_INLINE Pack<Number, W> larger(Pack<Number, W> a, Pack<Number, W> b) {
  return Pack<Number, W>(a.v > b.v ? a.v : b.v);
}

template <class Number, int W>
PASTEFIT_INLINE Pack<Number, W> smaller(Pack<Number, W> a, Pack<Number, W> b) {
  return Pack<Number, W>(a.v < b.v ? a.v : b.v);
}

/// The largest whole number that is not larger, of doubles below 2^51: a sum with 1.5 2^52 has no room for fractions.
template <int W>
PASTEFIT_INLINE Doubles<W> rounded_down(Doubles<W> a) {
  const Doubles<W> no_fraction(6755399441055744.0), nearest = (a + no_fraction) - no_fraction;
  return nearest - select(nearest > a, Doubles<W>(1.0), Doubles<W>(0.0));
}

/// True in some lane.
template <class Mask>
PASTEFIT_INLINE bool any(Mask mask) {
#ifdef __AVX512F__
  if constexpr (sizeof(Mask) == 64) {
    const __m512i lanes = reinterpret_cast<__m512i>(mask);
    return _mm512_test_epi32_mask(lanes, lanes) != 0;
  }
#endif
#ifdef __AVX__
  if constexpr (sizeof(Mask) == 32) return _mm256_movemask_ps(reinterpret_cast<__m256>(mask)) != 0;
#endif
#if PASTEFIT_X86
  if constexpr (sizeof(Mask) == 16) return _mm_movemask_ps(reinterpret_cast<__m128>(mask)) != 0;
#elif PASTEFIT_SIMD128
  return wasm_v128_any_true((v128_t)mask);
#else
  using Halves = typename LaneTypes<double, 2>::Mask;
  const Halves halves = reinterpret_cast<Halves>(mask);
  return (halves[0] | halves[1]) != 0;
#endif
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
PASTEFIT_INLINE double rounded_down(double a) {
  return std::floor(a);
}
PASTEFIT_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}
PASTEFIT_INLINE double smaller(double a, double b) {
  return a < b ? a : b;
}

}  // namespace pastefit
