#pragma once

#include <string_view>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/observe/heap.h"
#include "core/observe/outline.h"
#include "core/observe/readings.h"

namespace pastefit {

/// Reads a heap as the laboratory does, against the table on which it stands.
///
/// Between the tops of coarse grains a surface lies below the level that the laboratory's paste would have: in the
/// struck-off mould by `roughness` below the rim. Heights of the surface are read with that added, at any time; a
/// grain's top is where it is. A height is never above the highest point, and neither is above the mould.
class Ruler {
 public:
  /// The grains in the mould, before it is lifted.
  Ruler(const SlumpTest& test, double roughness_m, const Particles& in_mould);

  /// Sets the readings of this step, "step1" or "step2". What a heap does not have is absent: no width of nothing.
  void read(const Particles& grains, std::string_view step, Readings& readings) const;

  /// Sets "after_drops.height_mm", "after_drops.spread_mm" and the share that was spilled.
  void read_after_drops(const Particles& grains, Readings& readings) const;

  /// Width of the heap, the mean over all directions [m]; at most that of the table.
  double spread_m(const Particles& grains) const;

  /// No reading of a height is above this and the highest point of any grain [m].
  double above_highest_m() const { return roughness_m_; }

 private:
  struct Heights {
    Disc probe;  ///< where the surface is read
    double surface = 0, highest = 0;
  };
  Disc top(const Particles& grains) const;
  Heights heights(const Particles& grains) const;
  double read_height(const Heights& heights) const;
  double widest_m() const;

  const SlumpTest& test_;
  double roughness_m_;
  std::vector<char>
      on_top_;  ///< by identity: whether it lay in the struck-off top, which soft grains may carry below the rim
};

/// Shift of the struck-off top's middle over the mould's base radius beyond which a heap counts as sheared off.
/// EN 12350-2 and ASTM C143 have such a test repeated, and give no number. Heaps that flow on all sides shift by
/// 0.15 +- 0.08 (96 packings from 300 to 2,000 Pa), those that break by half a radius.
inline constexpr double kShearedShift = 0.4;

/// Whether the heap sheared off when the mould was lifted; not if its shift is unknown.
bool has_sheared(const SlumpTest& test, const Readings& readings);

/// How far the top shifted, over the shift beyond which a heap counts as sheared off; NaN: not read.
double shear_index(const SlumpTest& test, const Readings& readings);

/// The grains that have not left the table.
Particles on_table(const Particles& grains);

}  // namespace pastefit
