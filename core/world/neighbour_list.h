#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/domain.h"
#include "core/world/particles.h"

namespace pastefit {

/// Verlet list of a run of grains: pairs that may meet before the list is rebuilt. Sorted by the first grain, which a
/// pair therefore does not store. 4 bytes a pair.
class NeighbourList {
 public:
  /// List of its block that contains a pair; all are in the order of the candidates.
  enum Kept : std::uint32_t { nowhere, touching, near, bridge, kinds };

  /// A pair's second grain, and the list that contains it.
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
  /// Adds a pair of the current grain.
  void add(Pair pair) { pairs_.push_back(pair); }
  /// Moves on to the next grain.
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
  /// First grain of every pair; the vector may be longer.
  void first_grains(std::int32_t first, std::vector<std::int32_t>& grains) const;
  /// True if the lengths fit this number of grains.
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

/// Spheres as columns in single precision, and their grains. Entries behind the last one are read, not used.
struct SphereColumns {
  static constexpr int kBeyond = 16;  ///< readable entries behind the last one
  const float *x, *y, *z, *radius;
  const std::int32_t* grain;
};

/// A grain whose neighbours are wanted.
struct VicinityTask {
  SphereColumns others;
  std::int32_t from, count;  ///< of the others
  float place[3], radius;    ///< of the grain
  float gap, skin;           ///< near: closer than r + r' + gap r r'/(r + r') + skin
  Domain domain;
  std::int32_t* near;  ///< the grains found, with space for `kBeyond` behind them
};

/// Writes the near grains, in their order; returns their number.
using FindNear = std::int32_t (*)(const VicinityTask&);

/// Finds the neighbours of a grain among gathered grains. Works in single precision, relative to the centre of the
/// grains' box, with a margin of a millionth of the box: it may find too many.
class Vicinity {
 public:
  /// `farthest`: gap over radius for equal grains, over 2 R* for others; plus `skin` [m].
  Vicinity(const Particles& particles, const Domain& domain, double farthest, double skin, FindNear find_near);

  /// Removes all grains.
  void clear() { count_ = 0; }
  /// Gathers the grains `begin` <= j < `end`.
  void gather(std::int32_t begin, std::int32_t end);
  /// Calls `found(j)` for the neighbours of grain `i` among the gathered grains from index `from` on.
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
