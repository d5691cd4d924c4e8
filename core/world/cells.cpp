#include "core/world/cells.h"

#include <algorithm>

namespace pastefit {

namespace {

double component(const Vec3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace

Cells::Cells(const Particles& particles, const Domain& domain, double size) {
  Vec3 low = particles.motion[0].position, high = low;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Vec3& p = particles.motion[i].position;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  rows_close_ = domain.repeats();
  if (rows_close_) {
    low.x = 0;
    high.x = domain.period;
  }
  // A few stray grains must not make the grid huge: larger cells are slower, never wrong.
  const double most_cells = 64.0 * particles.count() + 1000;
  const Vec3 span = high - low;
  while ((span.x / size + 1) * (span.y / size + 1) * (span.z / size + 1) > most_cells) size *= 1.3;
  origin_ = low;
  inverse_size_.fill(1 / size);
  const auto cells_along = [&](int axis) { return static_cast<std::int32_t>(component(span, axis) / size) + 1; };
  std::stable_sort(axis_.begin() + (rows_close_ ? 1 : 0), axis_.end(),
                   [&](int a, int b) { return cells_along(a) < cells_along(b); });
  for (int k = 0; k < 3; ++k) n_[k] = cells_along(axis_[k]);
  if (!rows_close_) return;
  n_[0] = std::max(static_cast<std::int32_t>(domain.period / size), 1);
  inverse_size_[0] = n_[0] / domain.period;
}

std::int32_t Cells::along(double offset, int k) const {
  const double cell = offset * inverse_size_[k];
  return cell > 0 ? std::min(static_cast<std::int32_t>(std::min(cell, 1e9)), n_[k] - 1) : 0;
}

std::int32_t Cells::cell_of(const Vec3& point) const {
  const Vec3 offset = point - origin_;
  const auto place = [&](int k) { return along(component(offset, axis_[k]), k); };
  return (place(2) * n_[1] + place(1)) * n_[0] + place(0);
}

Sorted sort_by_cell(const Particles& particles, const Cells& cells) {
  const std::int32_t n = particles.count();
  Sorted sorted;
  std::vector<std::int32_t> cell(n);
  sorted.first.assign(cells.count() + 1, 0);
  for (std::int32_t i = 0; i < n; ++i) {
    cell[i] = cells.cell_of(particles.motion[i].position);
    ++sorted.first[cell[i] + 1];
  }
  for (std::int32_t c = 0; c < cells.count(); ++c) sorted.first[c + 1] += sorted.first[c];
  std::vector<std::int32_t> next(sorted.first.begin(), sorted.first.end() - 1);
  sorted.order.resize(n);
  for (std::int32_t i = 0; i < n; ++i) sorted.order[next[cell[i]]++] = i;
  return sorted;
}

}  // namespace pastefit
