#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/team.h"
#include "core/world/contacts.h"
#include "core/world/domain.h"
#include "core/world/particles.h"
#include "core/world/walls.h"

namespace pastefit {

/// Pairs near enough that they may meet before the list is made again, of a run of grains: one grain after the other,
/// so that a pair need not name its first one.
class Candidates {
 public:
  void clear();
  /// A pair of the grain at hand with grain `j`.
  void add(std::int32_t j, std::int32_t place);
  /// Goes on to the next grain.
  void end_grain() { ends_.push_back(static_cast<std::int32_t>(second_.size())); }

  /// Calls `look(c, i, j)` for all pairs; the run begins with grain `first`.
  template <class Look>
  void each(std::int32_t first, const Look& look) const {
    std::int32_t c = 0, i = first;
    for (const std::int32_t end : ends_) {
      for (; c < end; ++c) look(c, i, second_[c]);
      ++i;
    }
  }

  /// The second grain of the pair some way after this one, or of the last: to be fetched in time.
  std::int32_t ahead(std::int32_t c) const { return second_[std::min<std::size_t>(c + kAhead, second_.size() - 1)]; }

  /// Where a pair's memory is kept in the lists of its block: contact k (k), bridge k (-2 - k), nowhere (kNone).
  std::int32_t place(std::int32_t c) const { return place_[c]; }
  void set_place(std::int32_t c, std::int32_t place) { place_[c] = place; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(ends_, second_, place_);
  }
  static constexpr std::int32_t kNone = -1;
  static std::int32_t place_of_bridge(std::int32_t k) { return -2 - k; }
  static std::int32_t bridge_at(std::int32_t place) { return -2 - place; }

 private:
  static constexpr int kAhead = 12;

  std::vector<std::int32_t> ends_;  ///< by grain
  std::vector<std::int32_t> second_, place_;
};

/// Contacts of a block's grains with one wall, in the order of the grains.
struct WallContacts {
  ContactList contacts;
  std::int32_t count = 0;  ///< of them, without padding
  template <class Archive>
  void serialize(Archive& archive) {
    archive(contacts, count);
  }
};

/// A run of grains that are neighbours in space, with the pairs of which it holds the first grain. Their second grains
/// lie in the same block or in the next: blocks of the same parity can be worked on at the same time.
struct Block {
  std::int32_t grains = 0, grains_end = 0;
  Candidates candidates;
  ContactList contacts;
  BridgeList bridges;
  std::vector<WallContacts> walls;  ///< one for each wall of the world
  template <class Archive>
  void serialize(Archive& archive) {
    archive(grains, grains_end, candidates, contacts, bridges, walls);
  }
};

/// What acts between grains, by how much work it takes: contacts in full, bridges by their distance only; and what may
/// do so soon. The sums of a step are taken in the order of the blocks and their lists.
struct Pairs {
  std::vector<Block> blocks;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(blocks);
  }
};

/// Calls `work(block, member)` so that no two neighbouring blocks are worked on at the same time, and every block of
/// odd number after both of its neighbours. One member alone goes to and fro, so that what two blocks share stays in a
/// cache; sums have the same order.
template <class Work>
void in_two_rounds(Team& team, int blocks, const Work& work) {
  if (team.size() == 1) {
    for (int even = 0; even <= blocks; even += 2) {
      if (even < blocks) work(even, 0);
      if (even > 0) work(even - 1, 0);
    }
    return;
  }
  for (const int first : {0, 1})
    team.each((blocks + 1 - first) / 2, [&](int task, int member) { work(2 * task + first, member); });
}

/// The same, and `finish(block, member)` for every block as soon as it and the one before it have been worked on: no
/// pair touches its grains any more.
template <class Work, class Finish>
void in_two_rounds(Team& team, int blocks, const Work& work, const Finish& finish) {
  in_two_rounds(team, blocks, [&](int block, int member) {
    work(block, member);
    if (block == 0) finish(0, member);
    if (block % 2 == 0) return;
    finish(block, member);
    if (block + 1 < blocks) finish(block + 1, member);
  });
}

/// How far beyond touching two grains of the reference radius can act on each other.
struct AttractionReach {
  double formation_gap = 0;  ///< a bridge may form within it [m]
  double rupture_gap = 0;    ///< a living bridge acts within it [m]
  double tear_gap = 0;       ///< grains that have touched may stay in contact within it [m]
  double reference_radius = 1;
};

/// Sorts the grains in space (cells of the largest interaction plus skin), divides them into blocks, and lists all
/// pairs whose gap is below reach + skin. Contacts and bridges keep their memory; it is turned where a pair's order
/// changes. Of the walls the first ones stay what they were, if their number is another one now. Where the domain
/// repeats, grains are put back into it.
void rebuild(Particles& particles, const Domain& domain, Pairs& pairs, std::size_t walls, const AttractionReach& reach,
             double skin);

/// How far every grain may move before the acting pairs of its block are chosen anew, and from where. Where all is slow
/// the lists are tight; a grain near a fast one may be hit and has as much leeway as that.
struct Leeway {
  std::vector<Room> rooms;
  std::vector<double> own;  ///< what each grain by itself would be given; nothing, if it is asleep [m]
};

/// The deepest overlap of two grains over the smaller radius, and one of them.
struct Deepest {
  double overlap = 0;
  std::int32_t grain = -1;
};

/// Lists in the making, for one member of a team at a time; kept so that nothing is allocated in a steady scene.
struct Selection {
  ContactList contacts, near, dormant, at_wall;  ///< apart, because a list keeps the room it has once had
  BridgeList bridges, dormant_bridges;
  std::vector<std::int32_t> near_candidates, dormant_candidates;

  void clear();
  void pad(std::int32_t dummy);  ///< but for `at_wall`
};

/// Chooses from a block's candidates the pairs that act or may act while no grain moves beyond its leeway: contacts
/// those that may touch, bridges the rest; pairs of two grains that are asleep are dormant. `dummy`: the block's own,
/// for padding.
Deepest select_pairs(const Particles& particles, const Domain& domain, Block& block, std::int32_t dummy,
                     Selection& selection, const AttractionReach& reach, const Leeway& leeway);

/// Lists the block's grains that touch a wall or may do so while they stay within their leeway, and the wall within its
/// own [m].
void select_at_wall(const Particles& particles, const Wall& wall, const Block& block, WallContacts& touching,
                    Selection& selection, const AttractionReach& reach, const Leeway& leeway, double wall_leeway);

}  // namespace pastefit
