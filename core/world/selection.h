#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/neighbours.h"
#include "core/world/walls.h"

namespace pastefit {

/// Displacement bounds: how far every grain may move before the acting pairs of its block are selected anew. Bounds are
/// small where all grains are slow; a grain near a fast one may be hit and gets the same bound as that one.
struct DisplacementBounds {
  std::vector<DisplacementBound> bounds;
  std::vector<float> way;  ///< largest possible displacement from the present position, across the bound if need be [m]
  std::vector<float> own;  ///< bound from the grain's own speed [m]
};

/// The deepest overlap of two grains over the smaller radius, and one of the grains.
struct Deepest {
  double overlap = 0;
  std::int32_t grain = -1;
};

/// How near the grains of a candidate can come within their displacement bounds: bits of a byte.
namespace nearness {
enum Bit {
  touching,  ///< they overlap now
  near,      ///< they may touch
  held,      ///< they may stay in contact, if they are
  forming,   ///< a bridge may form
  bridged,   ///< may be within the reach of a living bridge
  kept       ///< from this bit on: `NeighbourList::Kept`
};
}  // namespace nearness

/// Candidates to test.
struct NearnessTask {
  const Motion* motion;
  const float* way;           ///< by grain
  const std::int32_t* first;  ///< grain of each pair
  std::span<const NeighbourList::Pair> pairs;
  Domain domain;
  AttractionReach reach;
  std::uint8_t* found;  ///< for each pair
};

/// Tests several pairs at a time; returns the deepest overlap among them.
using FindNearness = Deepest (*)(const NearnessTask&);

/// New lists of one member of a pool; kept so that a steady scene allocates nothing.
struct Selection {
  std::vector<std::int32_t> first;     ///< grains of the candidates
  std::vector<std::uint8_t> nearness;  ///< of the candidates
  /// By the list for which pairs are selected; the first `count` of each.
  std::array<std::vector<ChosenPair>, NeighbourList::kinds> pairs;
  std::array<std::size_t, NeighbourList::kinds> count{};
  ContactList contacts, fresh, at_wall;  ///< separate, because a list keeps its memory
  BridgeList bridges;

  void clear();  ///< all except `at_wall`
  std::span<ChosenPair> of(NeighbourList::Kept list) { return std::span(pairs[list]).first(count[list]); }
};

/// Selects from a block's candidates the pairs that act or may act within the displacement bounds: contacts if they may
/// touch, else bridges. `dummy`: that of the block, for padding.
Deepest select_pairs(const Particles& particles, const Domain& domain, Block& block, std::int32_t dummy,
                     Selection& selection, const AttractionReach& reach, const DisplacementBounds& bounds,
                     FindNearness find_nearness);

/// Lists the block's grains that touch a wall or may do so within their displacement bounds and that of the wall [m].
void select_at_wall(const Particles& particles, const Wall& wall, const Block& block, WallContacts& touching,
                    Selection& selection, const AttractionReach& reach, const DisplacementBounds& bounds,
                    double wall_bound);

}  // namespace pastefit
