#pragma once

#include <cstdint>
#include <vector>

#include "core/thread_pool.h"
#include "core/world/contacts.h"
#include "core/world/domain.h"
#include "core/world/neighbour_list.h"
#include "core/world/particles.h"

namespace pastefit {

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
  NeighbourList candidates;
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
void in_two_rounds(ThreadPool& pool, int blocks, const Work& work) {
  if (pool.size() == 1) {
    for (int even = 0; even <= blocks; even += 2) {
      if (even < blocks) work(even, 0);
      if (even > 0) work(even - 1, 0);
    }
    return;
  }
  for (const int first : {0, 1})
    pool.each((blocks + 1 - first) / 2, [&](int task, int member) { work(2 * task + first, member); });
}

/// The same, and `finish(block, member)` for every block as soon as it and the one before it have been worked on: no
/// pair touches its grains any more.
template <class Work, class Finish>
void in_two_rounds(ThreadPool& pool, int blocks, const Work& work, const Finish& finish) {
  in_two_rounds(pool, blocks, [&](int block, int member) {
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
  double pull_off_gap = 0;   ///< grains that have touched may stay in contact within it [m]
  double reference_radius = 1;
  bool viscous = false;  ///< bridges are contacts: they feel velocities and remember dampers
};

/// Sorts the grains in space (cells of the largest interaction plus skin), divides them into blocks, and lists all
/// pairs whose gap is below reach + skin. Contacts and bridges keep their memory; it is turned where a pair's order
/// changes. Of the walls the first ones stay what they were, if their number is another one now. Where the domain
/// repeats, grains are put back into it.
void rebuild(Particles& particles, const Domain& domain, Pairs& pairs, std::size_t walls, const AttractionReach& reach,
             double skin, FindNear find_near);

}  // namespace pastefit
