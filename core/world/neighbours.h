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
  std::int32_t count = 0;  ///< without padding
  template <class Archive>
  void serialize(Archive& archive) {
    archive(contacts, count);
  }
};

/// A run of grains that are neighbours in space, with the pairs whose first grain is among them. The second grains are
/// in the same block or the next:
///
///     block 0    block 1    block 2    block 3        grains, sorted in space
///     [....]-----[....]-----[....]-----[....]         pairs within a block and with the next
///      even       odd        even       odd           even blocks in parallel, then the odd ones
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

/// All pairs that act or may act soon, by cost: contacts in full, bridges by distance only. The sums of a step are
/// taken in the order of the blocks and their lists.
struct Pairs {
  std::vector<Block> blocks;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(blocks);
  }
};

/// Calls `work(block, member)` so that no two neighbouring blocks run at the same time, and every odd block after both
/// of its neighbours. A single thread alternates between them, so that data shared by two blocks stays in the cache;
/// sums have the same order.
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

/// The same, with `finish(block, member)` for every block as soon as it and the one before it are done: no pair acts on
/// its grains any more.
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

/// Largest gaps at which two grains of the reference radius interact.
struct AttractionReach {
  double formation_gap = 0;  ///< a bridge may form up to this gap [m]
  double rupture_gap = 0;    ///< a living bridge acts up to this gap [m]
  double pull_off_gap = 0;   ///< grains that have touched may stay in contact up to this gap [m]
  double reference_radius = 1;
  bool viscous = false;  ///< bridges are contacts: they need velocities and have a history of dampers
};

/// Sorts the grains in space (cells of the largest interaction plus skin), divides them into blocks, and lists all
/// pairs whose gap is below reach + skin. Contacts and bridges keep their history; it is reversed where the order of a
/// pair changes. If the number of walls has changed, the first ones are assumed to be the same. In a periodic domain
/// grains are moved back into it.
void rebuild(Particles& particles, const Domain& domain, Pairs& pairs, std::size_t walls, const AttractionReach& reach,
             double skin, FindNear find_near);

}  // namespace pastefit
