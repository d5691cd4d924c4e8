// Included once by each of kernels_{four_lanes,avx2,avx512}.cpp, which name the instruction set and the pack's width.
// Everything here lives in that namespace or is inlined: see core/laws/pack.h.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/laws/pack.h"
#include "core/laws/transpose.h"
#include "core/step/kernels.h"

namespace pastefit::PASTEFIT_ISA {

namespace {

constexpr int kListed = PASTEFIT_WIDTH;  // grains at a time

PASTEFIT_INLINE Singles<kListed> unaligned(const float* numbers) {
  Singles<kListed> pack;
  __builtin_memcpy(&pack.v, numbers, sizeof pack.v);
  return pack;
}

/// Writes the grains of the lanes that are within, one after the other; whole packs may be written. Returns how many.
/// It has no branches, because whether a pair is near cannot be predicted.
PASTEFIT_INLINE std::int32_t put_within(Singles<kListed>::Mask within, const std::int32_t* grain, int lanes,
                                        std::int32_t* near) {
#ifdef __AVX512F__
  if constexpr (kListed == 16) {
    const auto wanted = static_cast<__mmask16>(_mm512_movepi32_mask(reinterpret_cast<__m512i>(within)) &
                                               ((1U << std::min(lanes, kListed)) - 1));
    _mm512_storeu_si512(near, _mm512_maskz_compress_epi32(wanted, _mm512_loadu_si512(grain)));
    return __builtin_popcount(wanted);
  }
#endif
  std::int32_t found = 0;
  for (int lane = 0; lane < std::min(lanes, kListed); ++lane) {
    near[found] = grain[lane];
    found -= within[lane];
  }
  return found;
}

std::int32_t find_near(const VicinityTask& task) {
  using Spheres = Singles<kListed>;
  static_assert(SphereColumns::kBeyond >= kListed);
  const SphereColumns& others = task.others;
  const BasicVec3<Spheres> place{task.place[0], task.place[1], task.place[2]};
  const Spheres own(task.radius), gap = Spheres(task.gap) * own, skin(task.skin);
  std::int32_t found = 0;
  for (std::int32_t at = task.from; at < task.count; at += kListed) {
    BasicVec3<Spheres> way{unaligned(others.x + at) - place.x, unaligned(others.y + at) - place.y,
                           unaligned(others.z + at) - place.z};
    if (task.domain.repeats()) way = task.domain.shortest(way);
    const Spheres other = unaligned(others.radius + at), touch = own + other;
    const Spheres range = touch + gap * other / touch + skin;
    const Spheres square = way.x * way.x + way.y * way.y + way.z * way.z;
    found += put_within(square < range * range, others.grain + at, task.count - at, task.near + found);
  }
  return found;
}

constexpr int kLooked = kListed / 2;  // pairs at a time
using Looked = Doubles<kLooked>;

template <class Value, std::size_t... lane>
PASTEFIT_INLINE Looked gathered(const Value& value, std::index_sequence<lane...>) {
  return Looked(Looked::Lanes{static_cast<double>(value(lane))...});
}
/// A pack of one number for each lane.
template <class Value>
PASTEFIT_INLINE Looked gathered(const Value& value) {
  return gathered(value, std::make_index_sequence<kLooked>{});
}

/// Pairs whose distance is examined.
struct LookedPairs {
  Looked square;  ///< of the distance
  Looked touch;   ///< sum of the radii
  Looked one, other;
  Looked near;  ///< distance within which they may touch
};

PASTEFIT_INLINE LookedPairs read_pairs(const NearnessTask& task, const std::int32_t* i, const std::int32_t* j) {
  Looked columns[4];
  read_differences([&](int lane) { return &task.motion[i[lane]].position.x; },
                   [&](int lane) { return &task.motion[j[lane]].position.x; }, columns);
  const auto between = task.domain.shortest(BasicVec3<Looked>{columns[0], columns[1], columns[2]});
  LookedPairs p;
  p.square = dot(between, between);
  p.touch = columns[3];
  p.one = gathered([&](std::size_t lane) { return task.motion[i[lane]].radius; });
  p.other = gathered([&](std::size_t lane) { return task.motion[j[lane]].radius; });
  p.near = p.touch + gathered([&](std::size_t lane) { return task.way[i[lane]]; }) +
           gathered([&](std::size_t lane) { return task.way[j[lane]]; });
  return p;
}

PASTEFIT_INLINE Looked::Mask nearness_of(const NearnessTask& task, const LookedPairs& p) {
  const auto within = [&](const Looked& range, nearness::Bit bit) { return (p.square < range * range) & (1LL << bit); };
  Looked::Mask found = within(p.touch, nearness::touching) | within(p.near, nearness::near);
  const double pull_off = task.reach.pull_off_gap, rupture = task.reach.rupture_gap;
  if (pull_off <= 0 && rupture <= 0) return found;
  const Looked scale = Looked(2.0) * p.one * p.other / (p.touch * Looked(task.reach.reference_radius));
  if (pull_off > 0) found |= within(p.near + Looked(pull_off) * larger(scale, Looked(1.0)), nearness::held);
  if (rupture > 0) {
    const Looked forming(std::min(task.reach.formation_gap, rupture));
    found |= within(p.near + forming * scale, nearness::forming);
    found |= within(p.near + Looked(rupture) * scale, nearness::bridged);
  }
  return found;
}

/// Takes one branch for all pairs, because a pair is seldom deeper than all before it.
PASTEFIT_INLINE void note_deepest(const LookedPairs& p, const std::int32_t* i, Deepest& deepest) {
  const Looked smallest = smaller(p.one, p.other), deeper = p.touch - Looked(deepest.overlap) * smallest;
  const auto is_deeper = p.square < deeper * deeper;
  std::int64_t some = 0;
  for (int lane = 0; lane < kLooked; ++lane) some |= is_deeper[lane];
  if (some == 0) return;
  for (int lane = 0; lane < kLooked; ++lane) {
    const double overlap = (p.touch.v[lane] - std::sqrt(p.square.v[lane])) / smallest.v[lane];
    if (overlap > deepest.overlap) deepest = {overlap, i[lane]};
  }
}

Deepest find_nearness(const NearnessTask& task) {
  const std::size_t count = task.pairs.size();
  Deepest deepest;
  for (std::size_t first = 0; first < count; first += kLooked) {
    std::int32_t i[kLooked], j[kLooked];
    const std::size_t last = std::min<std::size_t>(first + kLooked, count) - 1;
    for (int lane = 0; lane < kLooked; ++lane) {
      const std::size_t k = std::min(first + lane, last);
      i[lane] = task.first[k];
      j[lane] = task.pairs[k].grain();
    }
    const LookedPairs p = read_pairs(task, i, j);
    const Looked::Mask found = nearness_of(task, p);
    note_deepest(p, i, deepest);
    for (std::size_t k = first; k <= last; ++k) task.found[k] = static_cast<std::uint8_t>(found[k - first]);
  }
  for (std::size_t k = 0; k < count; ++k)
    task.found[k] = static_cast<std::uint8_t>(task.found[k] | task.pairs[k].kept() << nearness::kept);
  return deepest;
}

}  // namespace

}  // namespace pastefit::PASTEFIT_ISA
