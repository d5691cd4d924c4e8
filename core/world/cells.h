#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/world/domain.h"
#include "core/world/particles.h"

namespace pastefit {

/// Cells of a box around the grains, at least `size` wide. Grains outside the box (none in a normal run) count in its
/// outermost cells. Cells are numbered along the shortest side of the box first, so that neighbouring cells are near
/// each other in memory even in a wide bed; along x first in a periodic domain, so that cells across the seam are in
/// one row.
class Cells {
 public:
  Cells(const Particles& particles, const Domain& domain, double size);

  std::int32_t count() const { return n_[0] * n_[1] * n_[2]; }
  std::int32_t layers() const { return n_[2]; }
  std::int32_t rows() const { return n_[1]; }
  std::int32_t row_length() const { return n_[0]; }
  std::int32_t cell_of(const Vec3& point) const;
  /// True if the last cell of a row is next to the first.
  bool rows_close() const { return rows_close_; }

 private:
  std::int32_t along(double offset, int k) const;

  Vec3 origin_;
  std::array<double, 3> inverse_size_{};    ///< along each axis of the box
  std::array<int, 3> axis_{0, 1, 2};        ///< of the box: shortest side first
  std::array<std::int32_t, 3> n_{1, 1, 1};  ///< cells along each
  bool rows_close_ = false;
};

/// Grains by cell.
struct Sorted {
  std::vector<std::int32_t> order;  ///< old index of the grain at each new place
  std::vector<std::int32_t> first;  ///< first place of every cell, then the number of grains
};
Sorted sort_by_cell(const Particles& particles, const Cells& cells);

}  // namespace pastefit
