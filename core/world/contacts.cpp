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

void Contacts::grow(std::int32_t n) {
  grow_columns(n, i, j, root_radius, root_mass, inverse_mass, size_scale, slip[0], slip[1], slip[2], roll[0], roll[1],
               roll[2], root_contact_radius, damper, drag, bridge);
}

void Contacts::append(std::int32_t a, std::int32_t b, double effective_radius, double effective_mass, double scale,
                      const ContactMemory& memory) {
  const std::int32_t k = count++;
  i[k] = a;
  j[k] = b;
  root_radius[k] = std::sqrt(effective_radius);
  root_mass[k] = std::sqrt(effective_mass);
  inverse_mass[k] = 1 / effective_mass;
  size_scale[k] = scale;
  slip[0][k] = memory.slip.x;
  slip[1][k] = memory.slip.y;
  slip[2][k] = memory.slip.z;
  roll[0][k] = memory.roll.x;
  roll[1][k] = memory.roll.y;
  roll[2][k] = memory.roll.z;
  root_contact_radius[k] = memory.root_contact_radius;
  damper[k] = memory.damper;
  drag[k] = memory.drag;
  bridge[k] = memory.bridge;
}

void Contacts::append(const Contacts& other, std::int32_t k) {
  const std::int32_t n = count++;
  i[n] = other.i[k];
  j[n] = other.j[k];
  root_radius[n] = other.root_radius[k];
  root_mass[n] = other.root_mass[k];
  inverse_mass[n] = other.inverse_mass[k];
  size_scale[n] = other.size_scale[k];
  for (int c = 0; c < 3; ++c) {
    slip[c][n] = other.slip[c][k];
    roll[c][n] = other.roll[c][k];
  }
  root_contact_radius[n] = other.root_contact_radius[k];
  damper[n] = other.damper[k];
  drag[n] = other.drag[k];
  bridge[n] = other.bridge[k];
}

void Contacts::pad(std::int32_t dummy) {
  const std::int32_t real = count;
  while (count % kBatch != 0) append(dummy, dummy, 1.0, 1.0, kNoSize, {});
  count = real;
}

void Bridges::grow(std::int32_t n) {
  grow_columns(n, i, j, size_scale, bridge);
}

void Bridges::append(std::int32_t a, std::int32_t b, double scale, double alive) {
  const std::int32_t k = count++;
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
