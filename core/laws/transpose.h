#pragma once

#include "core/laws/pack.h"

namespace pastefit {

/// Turns rows into packs and back, so that the record of a grain is read and written whole instead of by element.
/// `square` transposes W packs of W lanes in place: what was lane b of pack a becomes lane a of pack b.

PASTEFIT_INLINE void square(Pack<2> (&p)[2]) {
  const __m128d a = p[0].v, b = p[1].v;
  p[0].v = _mm_unpacklo_pd(a, b);
  p[1].v = _mm_unpackhi_pd(a, b);
}

#ifdef __AVX__
PASTEFIT_INLINE void square(Pack<4> (&p)[4]) {
  const __m256d low01 = _mm256_unpacklo_pd(p[0].v, p[1].v), high01 = _mm256_unpackhi_pd(p[0].v, p[1].v);
  const __m256d low23 = _mm256_unpacklo_pd(p[2].v, p[3].v), high23 = _mm256_unpackhi_pd(p[2].v, p[3].v);
  p[0].v = _mm256_permute2f128_pd(low01, low23, 0x20);
  p[1].v = _mm256_permute2f128_pd(high01, high23, 0x20);
  p[2].v = _mm256_permute2f128_pd(low01, low23, 0x31);
  p[3].v = _mm256_permute2f128_pd(high01, high23, 0x31);
}
#endif

#ifdef __AVX512F__
// The masked forms with a full mask avoid a false warning of GCC 12 about the unmasked ones and compile to the same
// code.
template <int control>
PASTEFIT_INLINE __m512d quarters(__m512d a, __m512d b) {
  return _mm512_maskz_shuffle_f64x2(0xff, a, b, control);
}

PASTEFIT_INLINE void square(Pack<8> (&p)[8]) {
  __m512d pair[8], quad[8];
  for (int k = 0; k < 8; k += 2) {
    pair[k] = _mm512_maskz_unpacklo_pd(0xff, p[k].v, p[k + 1].v);
    pair[k + 1] = _mm512_maskz_unpackhi_pd(0xff, p[k].v, p[k + 1].v);
  }
  for (int k = 0; k < 8; k += 4)
    for (int c = 0; c < 2; ++c) {
      quad[k + c] = quarters<0x88>(pair[k + c], pair[k + c + 2]);
      quad[k + c + 2] = quarters<0xdd>(pair[k + c], pair[k + c + 2]);
    }
  for (int k = 0; k < 4; ++k) {
    p[k].v = quarters<0x88>(quad[k], quad[k + 4]);
    p[k + 4].v = quarters<0xdd>(quad[k], quad[k + 4]);
  }
}
#endif

/// Columns of W rows of N doubles: packs[c] holds column c, lane l from row l. N is a multiple of W.
template <int W, int N, class Row>
PASTEFIT_INLINE void read_rows(Row row, Pack<W> (&packs)[N]) {
  for (int block = 0; block < N; block += W) {
    Pack<W> part[W];
    for (int lane = 0; lane < W; ++lane) part[lane] = Pack<W>::load(row(lane) + block);
    square(part);
    for (int k = 0; k < W; ++k) packs[block + k] = part[k];
  }
}

/// The columns of rows of four doubles.
template <int W, class Row>
PASTEFIT_INLINE void read_quads(Row row, Pack<W>& x, Pack<W>& y, Pack<W>& z, Pack<W>& w) {
#ifdef __AVX512F__
  if constexpr (W == 8) {
    __m512d pair[4];  // rows k and k + 4 side by side
    for (int k = 0; k < 4; ++k)
      pair[k] =
          _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_load_pd(row(k))), _mm256_load_pd(row(k + 4)), 1);
    const __m512d low01 = _mm512_maskz_unpacklo_pd(0xff, pair[0], pair[1]);
    const __m512d low23 = _mm512_maskz_unpacklo_pd(0xff, pair[2], pair[3]);
    const __m512d high01 = _mm512_maskz_unpackhi_pd(0xff, pair[0], pair[1]);
    const __m512d high23 = _mm512_maskz_unpackhi_pd(0xff, pair[2], pair[3]);
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    x.v = _mm512_permutex2var_pd(low01, first, low23);
    y.v = _mm512_permutex2var_pd(high01, first, high23);
    z.v = _mm512_permutex2var_pd(low01, second, low23);
    w.v = _mm512_permutex2var_pd(high01, second, high23);
    return;
  }
#endif
  if constexpr (W <= 4) {
    Pack<W> columns[4];
    read_rows<W, 4>(row, columns);
    x = columns[0];
    y = columns[1];
    z = columns[2];
    w = columns[3];
  }
}

}  // namespace pastefit
