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
  double contact_radius = 0;
  double bridge = 0;
};

/// Pairs that touch, hold a bridge, or may do so before the next look, as columns. 14 columns, 112 bytes a contact.
/// Order: by i, then by j; the sums of a step are taken in this order on every machine.
struct Contacts {
  Column<std::int32_t> i, j;
  Column<double> root_radius, root_mass, inverse_mass, size_scale;
  std::array<Column<double>, 3> slip, roll;
  Column<double> contact_radius, bridge;
  std::int32_t count = 0;  ///< without padding

  void clear();
  void append(std::int32_t a, std::int32_t b, double effective_radius, double effective_mass, double scale,
              const ContactMemory& memory);
  /// Takes over contact k of another list with all it holds.
  void append(const Contacts& other, std::int32_t k);
  /// Fills up to a multiple of kBatch with contacts of the dummy particle.
  void pad(std::int32_t dummy);
};

/// Pairs near enough that they may meet before the lists are made again.
struct Candidates {
  std::vector<std::int32_t> i, j;
  std::vector<std::int32_t> contact;  ///< index in Contacts, or -1
};

/// How far beyond touching two grains can act on each other.
struct Reach {
  double formation_gap = 0;  ///< at the reference radius: a bridge may form within it [m]
  double rupture_gap = 0;    ///< at the reference radius: a living bridge acts within it [m]
  double reference_radius = 1;
};

/// Sorts the grains in space (cells of the largest interaction plus skin, x fastest) and lists all pairs whose gap is
/// below reach + skin. Contacts keep their memory; it is turned where a pair's order changes.
/// Returns the new place of every grain by its old one, for those who also hold indices.
std::vector<std::int32_t> rebuild(Particles& particles, Contacts& contacts, Candidates& candidates, const Reach& reach,
                                  double skin);

/// The deepest overlap of two grains over the smaller radius, and one of them.
struct Deepest {
  double overlap = 0;
  std::int32_t grain = -1;
};

/// Chooses from the candidates the pairs that act or may act while no gap shrinks by more than `margin`.
Deepest select_contacts(const Particles& particles, Candidates& candidates, Contacts& contacts, Contacts& scratch,
                        const Reach& reach, double margin);

}  // namespace pastefit
