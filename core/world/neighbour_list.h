#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/domain.h"
#include "core/world/particles.h"

namespace pastefit {

/// Pairs near enough that they may meet before the list is made again, of a run of grains: one grain after the other,
/// so that a pair need not name its first one. 4 bytes a pair.
class NeighbourList {
 public:
  /// In which of its block's lists a pair is kept, in all of them in the order of the candidates.
  enum Kept : std::uint32_t { nowhere, touching, near, bridge, kinds };

  /// A pair's second grain, and where the pair is kept.
  class Pair {
   public:
    explicit Pair(std::int32_t grain, Kept kept = nowhere)
        : bits_(static_cast<std::uint32_t>(grain) | kept << kShift) {}
    Pair() = default;  ///< for vectors
    std::int32_t grain() const { return static_cast<std::int32_t>(bits_ & kGrain); }
    Kept kept() const { return static_cast<Kept>(bits_ >> kShift); }
    void keep(Kept kept) { *this = Pair(grain(), kept); }

   private:
    static constexpr int kShift = 29;  // half a billion grains
    static constexpr std::uint32_t kGrain = (1U << kShift) - 1;
    std::uint32_t bits_ = 0;
  };

  void clear();
  /// A pair of the grain at hand.
  void add(Pair pair) { pairs_.push_back(pair); }
  /// Goes on to the next grain.
  void end_grain() { ends_.push_back(static_cast<std::int32_t>(pairs_.size())); }

  /// Calls `visit(pair, i)` for all pairs; the run begins with grain `first`.
  template <class Visitor>
  void each(std::int32_t first, const Visitor& visit) {
    each(*this, first, visit);
  }
  template <class Visitor>
  void each(std::int32_t first, const Visitor& visit) const {
    each(*this, first, visit);
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(ends_, pairs_);
  }
  std::span<Pair> pairs() { return pairs_; }
  /// The first grain of every pair; there may be more of them behind.
  void first_grains(std::int32_t first, std::vector<std::int32_t>& grains) const;
  /// Whether they are of so many grains, as far as the lengths say.
  bool is_of(std::int32_t grains) const;

 private:
  template <class Self, class Visitor>
  static void each(Self& self, std::int32_t first, const Visitor& visit) {
    std::int32_t i = first, c = 0;
    for (const std::int32_t end : self.ends_) {
      for (; c < end; ++c) visit(self.pairs_[c], i);
      ++i;
    }
  }

  std::vector<std::int32_t> ends_;  ///< by grain
  std::vector<Pair> pairs_;
};

/// Spheres side by side, in single precision, and which grains they are. What lies behind the last one is read, not
/// looked at.
struct SphereColumns {
  static constexpr int kBeyond = 16;  ///< numbers behind it
  const float *x, *y, *z, *radius;
  const std::int32_t* grain;
};

/// One of which the neighbours are asked for.
struct VicinityTask {
  SphereColumns others;
  std::int32_t from, count;  ///< of the others
  float place[3], radius;    ///< its own
  float gap, skin;           ///< near: closer than r + r' + gap r r'/(r + r') + skin
  Domain domain;
  std::int32_t* near;  ///< the grains found, and room for `kBeyond` behind them
};

/// Writes those that are near, in their order; returns how many.
using FindNear = std::int32_t (*)(const VicinityTask&);

/// Finds the grains within reach of a grain among some that were gathered. It looks in single precision, from the
/// middle of the grains' box, and a millionth of the box farther than it is asked to: it may find too many.
class Vicinity {
 public:
  /// `farthest`: gap between grains of one radius over that radius, for pairs as 2 R*; `skin` [m] besides.
  Vicinity(const Particles& particles, const Domain& domain, double farthest, double skin, FindNear find_near);

  /// Begins anew with no grains.
  void clear() { count_ = 0; }
  /// Gathers the grains `begin` <= j < `end`.
  void gather(std::int32_t begin, std::int32_t end);
  /// Calls `found(j)` for those that are near grain `i`, of the gathered ones without the first `from`.
  template <class Found>
  void find(std::int32_t i, std::int32_t from, const Found& found) {
    const std::int32_t count = find_near_(task(i, from));
    for (std::int32_t k = 0; k < count; ++k) found(near_[k]);
  }

 private:
  enum Column { x, y, z, radius, columns };

  VicinityTask task(std::int32_t i, std::int32_t from);

  Domain domain_;
  double gap_, skin_;
  std::array<std::vector<float>, columns> all_, gathered_;
  std::vector<std::int32_t> grain_;  ///< of the gathered ones
  std::vector<std::int32_t> near_;
  std::int32_t count_ = 0;
  FindNear find_near_;
};

}  // namespace pastefit
