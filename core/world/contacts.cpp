#include "core/world/contacts.h"

#include <cmath>

namespace pastefit {

namespace {

/// Size scale of padding: the dummy pair sits on one spot, so it would form a bridge; this makes its energy vanish.
constexpr double kNoSize = 1e-30;

/// Columns grow by a tenth at a time, so that a steady scene allocates nothing and little is kept in vain.
template <class... Columns>
void grow_columns(std::int32_t n, Columns&... columns) {
  const auto grow_one = [n](auto& column) {
    const std::size_t needed = static_cast<std::size_t>(n) + kBatch;
    if (column.size() >= needed) return;
    column.reserve(needed + needed / 10);
    column.resize(needed + needed / 10);
  };
  (grow_one(columns), ...);
}

}  // namespace

void Choice::grow() {
  grow_columns(count + 1, i, j, source);
}

void Contacts::rearrange(Choice& choice, std::int32_t dummy) {
  count = choice.count;
  while (choice.count % kBatch != 0) choice.add(dummy, dummy, Choice::kNew);
  const std::int32_t* source = choice.source.data();
  const std::int32_t n = choice.count;
  const auto gather = [&](Column<double>& column) {
    if (spare_.size() < static_cast<std::size_t>(n)) {
      spare_.clear();
      grow_columns(n, spare_);
    }
    const double* from = column.data();
    for (std::int32_t k = 0; k < n; ++k) spare_[k] = source[k] < 0 ? 0.0 : from[source[k]];
    std::swap(column, spare_);
  };
  for (auto* column : {&root_radius, &root_mass, &inverse_mass, &size_scale, &slip[0], &slip[1], &slip[2], &roll[0],
                       &roll[1], &roll[2], &root_contact_radius, &damper, &drag, &bridge})
    gather(*column);
  std::swap(i, choice.i);
  std::swap(j, choice.j);
  for (std::int32_t k = count; k < n; ++k) describe(k, 1.0, 1.0, kNoSize);
  choice.clear();
}

void Contacts::describe(std::int32_t k, double effective_radius, double effective_mass, double scale) {
  root_radius[k] = std::sqrt(effective_radius);
  root_mass[k] = std::sqrt(effective_mass);
  inverse_mass[k] = 1 / effective_mass;
  size_scale[k] = scale;
}

void Bridges::grow(std::int32_t n) {
  grow_columns(n, i, j, size_scale, bridge);
}

void Bridges::append(std::int32_t a, std::int32_t b, double scale, double alive) {
  const std::int32_t k = count++;
  if (i.size() < static_cast<std::size_t>(count) + kBatch) grow(count);
  i[k] = a;
  j[k] = b;
  size_scale[k] = scale;
  bridge[k] = alive;
}

void Bridges::pad(std::int32_t dummy) {
  const std::int32_t real = count;
  while (count % kBatch != 0) append(dummy, dummy, kNoSize, 0.0);
  count = real;
}

}  // namespace pastefit
