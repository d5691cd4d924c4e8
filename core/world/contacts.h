#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/laws/constants.h"
#include "core/world/aligned.h"
#include "core/world/particles.h"

namespace pastefit {

/// Contacts are worked on in batches of this many; lists are padded to a multiple of it.
inline constexpr int kBatch = 8;

/// A list's length with its padding.
constexpr std::int32_t padded(std::int32_t count) {
  return (count + kBatch - 1) / kBatch * kBatch;
}

/// Which pairs a list of contacts is to hold next, in order, and whose memory each goes on with.
struct Choice {
  static constexpr std::int32_t kNew = -1;  ///< a source: the pair has met only now

  Column<std::int32_t> i, j, source;
  std::int32_t count = 0;

  void clear() { count = 0; }
  void add(std::int32_t a, std::int32_t b, std::int32_t from) {
    if (std::min(i.size(), source.size()) < static_cast<std::size_t>(count) + kBatch) grow();
    i[count] = a;
    j[count] = b;
    source[count++] = from;
  }

 private:
  void grow();
};

/// Pairs that touch or may touch before the next selection, as columns: 17 of them, 128 bytes a contact. What they
/// remember from step to step is explained with `Memory` in core/laws/contact.h.
/// Order: by i, then by j; the sums of a step are taken in this order on every machine.
/// The columns may be longer than the list: `count` says how much of them is meant.
struct Contacts {
  Column<std::int32_t> i, j;
  Column<double> root_radius, root_mass, inverse_mass, size_scale;
  std::array<Column<double>, 3> slip, roll;
  Column<double> root_contact_radius, damper, drag, bridge;
  std::int32_t count = 0;  ///< without padding

  std::int32_t padded() const { return pastefit::padded(count); }

  /// Becomes the list of `choice`, which is used up, padded with contacts of the dummy particle. New pairs remember
  /// nothing and are yet to be described. Column by column through one spare, so that no second list is kept.
  void rearrange(Choice& choice, std::int32_t dummy);
  /// Sets the constants of contact k.
  void describe(std::int32_t k, double effective_radius, double effective_mass, double scale);

 private:
  Column<double> spare_;
};

/// Pairs that attract each other across a gap, or may do so, but cannot touch before the next selection: all they need
/// is the distance. 4 columns, 24 bytes a pair. Order, length and padding as in `Contacts`.
struct Bridges {
  Column<std::int32_t> i, j;
  Column<double> size_scale, bridge;
  std::int32_t count = 0;

  std::int32_t padded() const { return pastefit::padded(count); }
  void clear() { count = 0; }
  void append(std::int32_t a, std::int32_t b, double scale, double alive);
  void pad(std::int32_t dummy);

 private:
  void grow(std::int32_t n);
};

}  // namespace pastefit
