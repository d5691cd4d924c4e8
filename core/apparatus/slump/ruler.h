#pragma once

#include <string_view>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/observe/heap.h"
#include "core/observe/outline.h"
#include "core/observe/readings.h"

namespace pastefit {

/// Measures a heap as the laboratory does, relative to its table.
///
/// The surface between the tops of coarse grains is lower than that of a paste, in the struck-off mould by `roughness`
/// below the rim. This is added to all heights of the surface; the top of a grain needs no correction. A height is
/// never above the highest point, nor that above the mould.
class Ruler {
 public:
  /// The grains in the mould before the lift.
  Ruler(const SlumpTest& test, double roughness_m, const Particles& in_mould);

  /// Sets the readings of this step, "step1" or "step2". Readings that a heap does not have are absent.
  void read(const Particles& grains, std::string_view step, Readings& readings) const;

  /// Sets "after_drops.height_mm", "after_drops.spread_mm" and the spilled share.
  void read_after_drops(const Particles& grains, Readings& readings) const;

  /// Width of the heap, mean over all directions [m]; at most that of the table.
  double spread_m(const Particles& grains) const;

  /// Heights read are at most this above the highest point of the grains [m].
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
  std::vector<char> on_top_;  ///< by identity: was in the struck-off top, which soft grains may carry below the rim
};

/// Shift of the centre of the struck-off top over the mould's base radius beyond which a heap counts as sheared off. EN
/// 12350-2 and ASTM C143 require such a test to be repeated but give no number. Heaps that flow on all sides shift by
/// 0.15 +- 0.08 (96 packings from 300 to 2,000 Pa), those that break by half a radius.
inline constexpr double kShearedShift = 0.4;

/// True if the heap sheared off when the mould was lifted; false if its shift is unknown.
bool has_sheared(const SlumpTest& test, const Readings& readings);

/// Shift of the top over the shift beyond which a heap counts as sheared off; NaN: not read.
double shear_index(const SlumpTest& test, const Readings& readings);

/// The grains that are still on the table.
Particles on_table(const Particles& grains);

}  // namespace pastefit
