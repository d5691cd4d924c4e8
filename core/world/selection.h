#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/neighbours.h"
#include "core/world/walls.h"

namespace pastefit {

/// How far every grain may move before the acting pairs of its block are chosen anew, and from where. Where all is slow
/// the lists are tight; a grain near a fast one may be hit and has as large a bound as that.
struct DisplacementBounds {
  std::vector<DisplacementBound> bounds;
  std::vector<float> way;  ///< how far each grain may still go from where it is, across its room if need be [m]
  std::vector<float> own;  ///< what each grain by itself would be given [m]
};

/// The deepest overlap of two grains over the smaller radius, and one of them.
struct Deepest {
  double overlap = 0;
  std::int32_t grain = -1;
};

/// How near the grains of a candidate are to each other while none leaves its room: bits of a byte.
namespace nearness {
enum Bit {
  touching,  ///< they overlap now
  near,      ///< they may touch
  held,      ///< they may stay in contact if they are
  forming,   ///< a bridge may form
  bridged,   ///< may be within the reach of a bridge that lives
  kept       ///< from here on: `NeighbourList::Kept`
};
}  // namespace nearness

/// Candidates to be looked at.
struct NearnessTask {
  const Motion* motion;
  const float* way;           ///< by grain
  const std::int32_t* first;  ///< grain of each pair
  std::span<const NeighbourList::Pair> pairs;
  Domain domain;
  AttractionReach reach;
  std::uint8_t* found;  ///< for each pair
};

/// Looks at pairs, several at a time; returns the deepest overlap among them.
using FindNearness = Deepest (*)(const NearnessTask&);

/// Lists in the making, for one member of a pool at a time; kept so that nothing is allocated in a steady scene.
struct Selection {
  std::vector<std::int32_t> first;     ///< grains of the candidates
  std::vector<std::uint8_t> nearness;  ///< of the candidates
  /// By the list that pairs are chosen for; of each the first `count`.
  std::array<std::vector<ChosenPair>, NeighbourList::kinds> pairs;
  std::array<std::size_t, NeighbourList::kinds> count{};
  ContactList contacts, fresh, at_wall;  ///< apart, because a list keeps the room it has once had
  BridgeList bridges;

  void clear();  ///< all but `at_wall`
  std::span<ChosenPair> of(NeighbourList::Kept list) { return std::span(pairs[list]).first(count[list]); }
};

/// Chooses from a block's candidates the pairs that act or may act while no grain leaves its room: contacts
/// those that may touch, bridges the rest. `dummy`: the block's own, for padding.
Deepest select_pairs(const Particles& particles, const Domain& domain, Block& block, std::int32_t dummy,
                     Selection& selection, const AttractionReach& reach, const DisplacementBounds& bounds,
                     FindNearness find_nearness);

/// Lists the block's grains that touch a wall or may do so while they stay in their bounds, and the wall within its
/// displacement bound [m].
void select_at_wall(const Particles& particles, const Wall& wall, const Block& block, WallContacts& touching,
                    Selection& selection, const AttractionReach& reach, const DisplacementBounds& bounds,
                    double wall_bound);

}  // namespace pastefit
