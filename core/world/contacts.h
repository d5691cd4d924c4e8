#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/laws/constants.h"
#include "core/world/aligned.h"
#include "core/world/particles.h"

namespace pastefit {

/// Contacts are worked on in batches of this many; lists are padded to a multiple of it.
inline constexpr int kBatch = 8;

/// What one contact remembers from step to step (see `Memory` in core/laws/contact.h).
struct ContactMemory {
  Vec3 slip;
  Vec3 roll;
  double root_contact_radius = 0;
  double damper = 0;
  double drag = 0;
  double bridge = 0;
};

/// Pairs that touch or may touch before the next selection, as columns: 16 of them, 120 bytes a contact.
/// Order: by i, then by j; the sums of a step are taken in this order on every machine.
/// The columns are as long as the longest list so far and are not cleared: `count` says how much of them is meant.
struct Contacts {
  Column<std::int32_t> i, j;
  Column<double> root_radius, root_mass, inverse_mass, size_scale;
  std::array<Column<double>, 3> slip, roll;
  Column<double> root_contact_radius, damper, drag, bridge;
  std::int32_t count = 0;  ///< without padding

  std::int32_t padded() const { return (count + kBatch - 1) / kBatch * kBatch; }
  void clear() { count = 0; }
  /// Makes room for n contacts and their padding.
  void reserve(std::int32_t n) {
    if (i.size() < static_cast<std::size_t>(n) + kBatch) grow(n);
  }
  /// Requirement: there is room.
  void append(std::int32_t a, std::int32_t b, double effective_radius, double effective_mass, double scale,
              const ContactMemory& memory);
  /// Takes over contact k of another list with all it holds.
  void append(const Contacts& other, std::int32_t k);
  /// Fills up to a multiple of kBatch with contacts of the dummy particle. Requirement: there is room.
  void pad(std::int32_t dummy);

 private:
  void grow(std::int32_t n);
};

/// Pairs that attract each other across a gap, or may do so, but cannot touch before the next selection: all they need
/// is the distance. 4 columns, 24 bytes a pair. Order, length and padding as in `Contacts`.
struct Bridges {
  Column<std::int32_t> i, j;
  Column<double> size_scale, bridge;
  std::int32_t count = 0;

  std::int32_t padded() const { return (count + kBatch - 1) / kBatch * kBatch; }
  void clear() { count = 0; }
  void reserve(std::int32_t n) {
    if (i.size() < static_cast<std::size_t>(n) + kBatch) grow(n);
  }
  void append(std::int32_t a, std::int32_t b, double scale, double alive);
  void pad(std::int32_t dummy);

 private:
  void grow(std::int32_t n);
};

}  // namespace pastefit
