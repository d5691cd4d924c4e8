#pragma once

#include "core/laws/pack.h"

namespace pastefit {

/// Between the rows in which a grain lies in memory, four doubles each, and packs with a lane for each contact.

/// Transposes W packs of W lanes in place: what was lane b of pack a becomes lane a of pack b.
PASTEFIT_INLINE void transpose(Doubles<2> (&p)[2]) {
  const __m128d a = p[0].v, b = p[1].v;
  p[0].v = _mm_unpacklo_pd(a, b);
  p[1].v = _mm_unpackhi_pd(a, b);
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

/// Adds four numbers to four doubles.
PASTEFIT_INLINE void add_to_row(double* row, __m128 quad) {
#ifdef __AVX__
  _mm256_store_pd(row, _mm256_add_pd(_mm256_load_pd(row), _mm256_cvtps_pd(quad)));
#else
  _mm_store_pd(row, _mm_add_pd(_mm_load_pd(row), _mm_cvtps_pd(quad)));
  _mm_store_pd(row + 2, _mm_add_pd(_mm_load_pd(row + 2), _mm_cvtps_pd(_mm_movehl_ps(quad, quad))));
#endif
}

/// Quads of W rows to packs of their columns, and back.
PASTEFIT_INLINE void transpose(Singles<4> (&p)[4]) {
  const __m128 low01 = _mm_unpacklo_ps(p[0].v, p[1].v), high01 = _mm_unpackhi_ps(p[0].v, p[1].v);
  const __m128 low23 = _mm_unpacklo_ps(p[2].v, p[3].v), high23 = _mm_unpackhi_ps(p[2].v, p[3].v);
  p[0].v = _mm_movelh_ps(low01, low23);
  p[1].v = _mm_movehl_ps(low23, low01);
  p[2].v = _mm_movelh_ps(high01, high23);
  p[3].v = _mm_movehl_ps(high23, high01);
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

/// The columns of W quads.
template <int W, class Row>
PASTEFIT_INLINE void read_quads(Row row, Singles<W> (&columns)[4]) {
  for (int k = 0; k < 4; ++k) {
    if constexpr (W == 4) columns[k].v = _mm_load_ps(row(k));
#ifdef __AVX__
    if constexpr (W == 8) columns[k].v = _mm256_set_m128(_mm_load_ps(row(k + 4)), _mm_load_ps(row(k)));
#endif
  }
  transpose(columns);
}

/// Adds lane l of the four columns to the four doubles at `row(l)`, in the order of the lanes.
template <int W, class Row>
PASTEFIT_INLINE void add_quads(Row row, Singles<W> (&columns)[4]) {
  transpose(columns);
  for (int lane = 0; lane < 4; ++lane) {
    if constexpr (W == 4) add_to_row(row(lane), columns[lane].v);
#ifdef __AVX__
    if constexpr (W == 8) add_to_row(row(lane), _mm256_castps256_ps128(columns[lane].v));
#endif
  }
#ifdef __AVX__
  if constexpr (W == 8)
    for (int lane = 0; lane < 4; ++lane) add_to_row(row(lane + 4), _mm256_extractf128_ps(columns[lane].v, 1));
#endif
}

/// Vectors from the first of two rows to the second, and the sums of what is beside them, in columns.
template <int W, class Row>
PASTEFIT_INLINE void read_differences(Row from, Row to, Doubles<W> (&columns)[4]) {
  using Mask = typename Doubles<W>::Mask;
  for (int block = 0; block < 4; block += W) {
    Mask sign{};
    for (int k = 0; k < W; ++k) sign[k] = block + k < 3 ? 1LL << 63 : 0;
    Doubles<W> part[W];
    for (int lane = 0; lane < W; ++lane) {
      const Mask turned = reinterpret_cast<Mask>(Doubles<W>::load(from(lane) + block).v) ^ sign;
      part[lane].v = reinterpret_cast<typename Doubles<W>::Lanes>(turned) + Doubles<W>::load(to(lane) + block).v;
    }
    transpose(part);
    for (int k = 0; k < W; ++k) columns[block + k] = part[k];
  }
}

/// W doubles in two packs, rounded.
PASTEFIT_INLINE Singles<4> narrow(Doubles<2> first, Doubles<2> second) {
  return Singles<4>(_mm_movelh_ps(_mm_cvtpd_ps(first.v), _mm_cvtpd_ps(second.v)));
}
#ifdef __AVX__
PASTEFIT_INLINE Singles<8> narrow(Doubles<4> first, Doubles<4> second) {
  return Singles<8>(_mm256_set_m128(_mm256_cvtpd_ps(second.v), _mm256_cvtpd_ps(first.v)));
}
#endif

/// The first or second half of a pack in doubles.
template <int half>
PASTEFIT_INLINE Doubles<2> widened(Singles<4> a) {
  return Doubles<2>(_mm_cvtps_pd(half == 0 ? a.v : _mm_movehl_ps(a.v, a.v)));
}
#ifdef __AVX__
template <int half>
PASTEFIT_INLINE Doubles<4> widened(Singles<8> a) {
  return Doubles<4>(_mm256_cvtps_pd(_mm256_extractf128_ps(a.v, half)));
}
#endif

}  // namespace pastefit
