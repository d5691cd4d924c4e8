#pragma once

#include "core/laws/pack.h"

namespace pastefit {

/// Between the rows in which a grain lies in memory, four or eight numbers each, and packs with a lane for each
/// contact.

/// Transposes W packs of W lanes in place: what was lane b of pack a becomes lane a of pack b.
PASTEFIT_INLINE void transpose(Doubles<2> (&p)[2]) {
  const Doubles<2>::Lanes a = p[0].v, b = p[1].v;
  p[0].v = __builtin_shufflevector(a, b, 0, 2);
  p[1].v = __builtin_shufflevector(a, b, 1, 3);
}

#ifdef __AVX__
PASTEFIT_INLINE void transpose(Doubles<4> (&p)[4]) {
  const __m256d low01 = _mm256_unpacklo_pd(p[0].v, p[1].v), high01 = _mm256_unpackhi_pd(p[0].v, p[1].v);
  const __m256d low23 = _mm256_unpacklo_pd(p[2].v, p[3].v), high23 = _mm256_unpackhi_pd(p[2].v, p[3].v);
  p[0].v = _mm256_permute2f128_pd(low01, low23, 0x20);
  p[1].v = _mm256_permute2f128_pd(high01, high23, 0x20);
  p[2].v = _mm256_permute2f128_pd(low01, low23, 0x31);
  p[3].v = _mm256_permute2f128_pd(high01, high23, 0x31);
}
#endif

/// Quads of W rows to packs of their columns, and back.
PASTEFIT_INLINE void transpose(Singles<4> (&p)[4]) {
  const auto low01 = __builtin_shufflevector(p[0].v, p[1].v, 0, 4, 1, 5);
  const auto high01 = __builtin_shufflevector(p[0].v, p[1].v, 2, 6, 3, 7);
  const auto low23 = __builtin_shufflevector(p[2].v, p[3].v, 0, 4, 1, 5);
  const auto high23 = __builtin_shufflevector(p[2].v, p[3].v, 2, 6, 3, 7);
  p[0].v = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  p[1].v = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  p[2].v = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  p[3].v = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

#ifdef __AVX__
PASTEFIT_INLINE void transpose(Singles<8> (&p)[4]) {
  const __m256d low01 = _mm256_castps_pd(_mm256_unpacklo_ps(p[0].v, p[1].v));
  const __m256d high01 = _mm256_castps_pd(_mm256_unpackhi_ps(p[0].v, p[1].v));
  const __m256d low23 = _mm256_castps_pd(_mm256_unpacklo_ps(p[2].v, p[3].v));
  const __m256d high23 = _mm256_castps_pd(_mm256_unpackhi_ps(p[2].v, p[3].v));
  p[0].v = _mm256_castpd_ps(_mm256_unpacklo_pd(low01, low23));
  p[1].v = _mm256_castpd_ps(_mm256_unpackhi_pd(low01, low23));
  p[2].v = _mm256_castpd_ps(_mm256_unpacklo_pd(high01, high23));
  p[3].v = _mm256_castpd_ps(_mm256_unpackhi_pd(high01, high23));
}
#endif

#ifdef __AVX512F__
PASTEFIT_INLINE void transpose(Singles<16> (&p)[4]) {
  const __m512d low01 = _mm512_castps_pd(_mm512_unpacklo_ps(p[0].v, p[1].v));
  const __m512d high01 = _mm512_castps_pd(_mm512_unpackhi_ps(p[0].v, p[1].v));
  const __m512d low23 = _mm512_castps_pd(_mm512_unpacklo_ps(p[2].v, p[3].v));
  const __m512d high23 = _mm512_castps_pd(_mm512_unpackhi_ps(p[2].v, p[3].v));
  p[0].v = _mm512_castpd_ps(_mm512_unpacklo_pd(low01, low23));
  p[1].v = _mm512_castpd_ps(_mm512_unpackhi_pd(low01, low23));
  p[2].v = _mm512_castpd_ps(_mm512_unpacklo_pd(high01, high23));
  p[3].v = _mm512_castpd_ps(_mm512_unpackhi_pd(high01, high23));
}
#endif

/// The columns of W quads.
template <int W, class Row>
PASTEFIT_INLINE void read_quads(Row row, Singles<W> (&columns)[4]) {
  for (int k = 0; k < 4; ++k) {
    if constexpr (W == 4) columns[k] = Singles<4>::load(row(k));
#ifdef __AVX__
    if constexpr (W == 8) columns[k].v = _mm256_set_m128(_mm_load_ps(row(k + 4)), _mm_load_ps(row(k)));
#endif
#ifdef __AVX512F__
    if constexpr (W == 16) {
      __m512 quads = _mm512_castps128_ps512(_mm_load_ps(row(k)));
      quads = _mm512_insertf32x4(quads, _mm_load_ps(row(k + 4)), 1);
      quads = _mm512_insertf32x4(quads, _mm_load_ps(row(k + 8)), 2);
      columns[k].v = _mm512_insertf32x4(quads, _mm_load_ps(row(k + 12)), 3);
    }
#endif
  }
  transpose(columns);
}

/// Four columns and four more, on their way back into W rows of eight.
template <int W>
struct Columns {
  Singles<W> first[4], second[4];

  PASTEFIT_INLINE void turn() {
    transpose(first);
    transpose(second);
  }
  /// Adds, once turned, lane l of the columns to the eight numbers at `row(l)`: lanes `begin` to `begin` + min(W, 8),
  /// in their order.
  template <int begin, class Row>
  PASTEFIT_INLINE void add_to(Row row) const {
    const auto add = [&](int lane, auto numbers, int from) {
      float* const sums = row(begin + lane) + from;
      (decltype(numbers)::load(sums) + numbers).store(sums);
    };
    if constexpr (W == 4)
      for (int k = 0; k < 4; ++k) {
        add(k, first[k], 0);
        add(k, second[k], 4);
      }
#ifdef __AVX__
    if constexpr (W == 8) {
      for (int k = 0; k < 4; ++k) add(k, Singles<8>(_mm256_permute2f128_ps(first[k].v, second[k].v, 0x20)), 0);
      for (int k = 0; k < 4; ++k) add(k + 4, Singles<8>(_mm256_permute2f128_ps(first[k].v, second[k].v, 0x31)), 0);
    }
#endif
#ifdef __AVX512F__
    if constexpr (W == 16) {
      const __m512i quads =
          begin == 0 ? _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0) : _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
      __m512 rows[4];  // k and k + 4
      for (int k = 0; k < 4; ++k)
        rows[k] = _mm512_castpd_ps(
            _mm512_permutex2var_pd(_mm512_castps_pd(first[k].v), quads, _mm512_castps_pd(second[k].v)));
      for (int k = 0; k < 4; ++k) add(k, Singles<8>(_mm512_castps512_ps256(rows[k])), 0);
      for (int k = 0; k < 4; ++k) add(k + 4, Singles<8>(_mm512_extractf32x8_ps(rows[k], 1)), 0);
    }
#endif
  }
};

/// Vectors from the first of two rows to the second, and the sums of what is beside them, in columns.
template <int W, class From, class To>
PASTEFIT_INLINE void read_differences(From from, To to, Doubles<W> (&columns)[4]) {
#ifdef __AVX512F__
  if constexpr (W == 8) {
    const Doubles<8> sign(_mm512_set_pd(1, -1, -1, -1, 1, -1, -1, -1));
    const auto two = [](const double* row, const double* other) {
      return Doubles<8>(_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(row)), _mm256_load_pd(other), 1));
    };
    const auto differences = [&](int lane) {
      return fused(sign, two(from(lane), from(lane + 2)), two(to(lane), to(lane + 2))).v;
    };
    const __m512d part[4] = {differences(0), differences(1), differences(4), differences(5)};
    const __m512d low[2] = {_mm512_unpacklo_pd(part[0], part[1]), _mm512_unpacklo_pd(part[2], part[3])};
    const __m512d high[2] = {_mm512_unpackhi_pd(part[0], part[1]), _mm512_unpackhi_pd(part[2], part[3])};
    columns[0].v = _mm512_shuffle_f64x2(low[0], low[1], 0x88);
    columns[1].v = _mm512_shuffle_f64x2(high[0], high[1], 0x88);
    columns[2].v = _mm512_shuffle_f64x2(low[0], low[1], 0xDD);
    columns[3].v = _mm512_shuffle_f64x2(high[0], high[1], 0xDD);
    return;
  }
#endif
  if constexpr (W <= 4) {
    for (int block = 0; block < 4; block += W) {
      Doubles<W> sign, part[W];
      for (int k = 0; k < W; ++k) sign.v[k] = block + k < 3 ? -1 : 1;
      for (int lane = 0; lane < W; ++lane)
        part[lane] = fused(sign, Doubles<W>::load(from(lane) + block), Doubles<W>::load(to(lane) + block));
      transpose(part);
      for (int k = 0; k < W; ++k) columns[block + k] = part[k];
    }
  }
}

/// W doubles in two packs, rounded.
PASTEFIT_INLINE Singles<4> narrow(Doubles<2> first, Doubles<2> second) {
#if PASTEFIT_X86
  return Singles<4>(_mm_movelh_ps(_mm_cvtpd_ps(first.v), _mm_cvtpd_ps(second.v)));
#elif PASTEFIT_SIMD128
  v128_t low = wasm_f32x4_demote_f64x2_zero((v128_t)first.v), high = wasm_f32x4_demote_f64x2_zero((v128_t)second.v);
  __asm__("" : "+r"(low), "+r"(high));  // or else LLVM 14 takes them apart and rounds each lane on its own
  return Singles<4>(__builtin_shufflevector((Singles<4>::Lanes)low, (Singles<4>::Lanes)high, 0, 1, 4, 5));
#else
  using Half = LaneTypes<float, 2>::Lanes;
  return Singles<4>(__builtin_shufflevector(__builtin_convertvector(first.v, Half),
                                            __builtin_convertvector(second.v, Half), 0, 1, 2, 3));
#endif
}
#ifdef __AVX__
PASTEFIT_INLINE Singles<8> narrow(Doubles<4> first, Doubles<4> second) {
  return Singles<8>(_mm256_set_m128(_mm256_cvtpd_ps(second.v), _mm256_cvtpd_ps(first.v)));
}
#endif
#ifdef __AVX512F__
PASTEFIT_INLINE Singles<16> narrow(Doubles<8> first, Doubles<8> second) {
  const __m512 lower = _mm512_castps256_ps512(_mm512_cvtpd_ps(first.v));
  return Singles<16>(_mm512_insertf32x8(lower, _mm512_cvtpd_ps(second.v), 1));
}
#endif

/// The first or second half of a pack in doubles.
template <int half>
PASTEFIT_INLINE Doubles<2> widened(Singles<4> a) {
#if PASTEFIT_X86
  return Doubles<2>(_mm_cvtps_pd(half == 0 ? a.v : _mm_movehl_ps(a.v, a.v)));
#else
  return Doubles<2>(
      __builtin_convertvector(__builtin_shufflevector(a.v, a.v, 2 * half, 2 * half + 1), Doubles<2>::Lanes));
#endif
}
#ifdef __AVX__
template <int half>
PASTEFIT_INLINE Doubles<4> widened(Singles<8> a) {
  return Doubles<4>(_mm256_cvtps_pd(_mm256_extractf128_ps(a.v, half)));
}
#endif
#ifdef __AVX512F__
template <int half>
PASTEFIT_INLINE Doubles<8> widened(Singles<16> a) {
  return Doubles<8>(_mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, half)));
}
#endif

}  // namespace pastefit
