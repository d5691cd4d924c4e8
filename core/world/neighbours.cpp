#include "core/world/neighbours.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/world/cells.h"

namespace pastefit {

namespace {

constexpr std::int32_t kGrainsPerBlock = 600;  // at least; small, so that one displaced grain affects few others

double largest_of(const Particles& particles) {
  double largest = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) largest = std::max(largest, particles.motion[i].radius);
  return largest;
}

/// History of the pairs of the old blocks, by the lower new index of their grains: used after the grains were sorted. A
/// block's old lists are freed when the grains they belong to are done, so that there are never two lists of the whole
/// scene.
class Remembered {
 public:
  Remembered(std::vector<Block>& blocks, const std::vector<std::int32_t>& new_place)
      : blocks_(blocks), last_(blocks.size(), -1), first_(new_place.size() + 1, 0), met_(new_place.size(), -1) {
    const auto each = [&](const auto& look) {
      const auto look_at = [&](std::int32_t b, std::int32_t i, std::int32_t j, bool bridge, std::int32_t k) {
        if (i == j) return;  // padding
        const std::int32_t a = new_place[i], c = new_place[j];
        look(std::min(a, c), Known{std::max(a, c), k, b, bridge, a > c});
      };
      for (std::int32_t b = 0; b < static_cast<std::int32_t>(blocks.size()); ++b) {
        const ContactList& contacts = blocks[b].contacts;
        const BridgeList& bridges = blocks[b].bridges;
        for (std::int32_t k = 0; k < contacts.count; ++k)
          if (contacts.remembers(k)) look_at(b, contacts.first(k), contacts.second(k), false, k);
        for (std::int32_t k = 0; k < bridges.count; ++k)
          if (bridges.bond(k) > 0) look_at(b, bridges.first(k), bridges.second(k), true, k);
      }
    };
    each([&](std::int32_t lower, const Known&) { ++first_[lower + 1]; });
    for (std::size_t i = 0; i < new_place.size(); ++i) first_[i + 1] += first_[i];
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    known_.resize(first_.back());
    each([&](std::int32_t lower, const Known& known) {
      last_[known.block] = std::max(last_[known.block], lower);
      known_[next[lower]++] = known;
    });
    for (Block& block : blocks) block.candidates = {};
  }

  /// Frees lists whose pairs all have a lower index below `grain`.
  void forget_before(std::int32_t grain) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (last_[b] >= grain) continue;
      blocks_[b].contacts = {};
      blocks_[b].bridges = {};
    }
  }

  /// Call before asking for the pairs of grain `i`.
  void turn_to(std::int32_t i) {
    for (std::int32_t p = first_[i]; p < first_[i + 1]; ++p) met_[known_[p].upper] = p;
  }

  /// Adds the pair's history to the block's lists; returns the list.
  NeighbourList::Kept recall(std::int32_t i, std::int32_t j, Block& block) const {
    const std::int32_t p = met_[j];
    if (p < first_[i] || p >= first_[i + 1]) return NeighbourList::nowhere;
    const Known& known = known_[p];
    const Block& old = blocks_[known.block];
    if (known.bridge) {
      block.bridges.add(i, j, 0, old.bridges.bond(known.place));
      return NeighbourList::bridge;
    }
    const Contact contact = old.contacts.contact(known.place);
    block.contacts.add(i, j, known.turned ? contact.turned() : contact);
    return NeighbourList::touching;
  }

 private:
  struct Known {
    std::int32_t upper, place, block;
    bool bridge, turned;
  };
  std::vector<Block>& blocks_;
  std::vector<std::int32_t> last_;   ///< by block: the largest lower index among its pairs
  std::vector<std::int32_t> first_;  ///< by the lower grain
  std::vector<std::int32_t> met_;    ///< by the upper grain: its pair with the current lower grain, if any
  std::vector<Known> known_;
};

/// Moves the contacts with a wall to the blocks that contain their grains now.
void redistribute(const std::vector<Block>& old, std::size_t wall, const std::vector<std::int32_t>& new_place,
                  std::vector<Block>& blocks) {
  struct Known {
    std::int32_t grain;
    Contact contact;
  };
  std::vector<Known> known;
  for (const Block& block : old) {
    if (wall >= block.walls.size()) continue;
    const WallContacts& touching = block.walls[wall];
    for (std::int32_t k = 0; k < touching.count; ++k)
      known.push_back({new_place[touching.contacts.first(k)], touching.contacts.contact(k)});
  }
  std::sort(known.begin(), known.end(), [](const Known& a, const Known& b) { return a.grain < b.grain; });
  auto block = blocks.begin();
  for (const auto& [grain, contact] : known) {
    while (grain >= block->grains_end) ++block;
    block->walls[wall].contacts.add(grain, grain, contact);
    ++block->walls[wall].count;
  }
}

/// Whole layers of cells, so that a grain's neighbours are in its block or the next.
std::vector<Block> blocks_of(const Cells& cells, const std::vector<std::int32_t>& first) {
  std::vector<Block> blocks;
  const std::int32_t layer = cells.rows() * cells.row_length();
  std::int32_t begin = 0;
  for (std::int32_t l = 1; l <= cells.layers(); ++l) {
    const std::int32_t end = first[l * layer];
    if (end - begin < kGrainsPerBlock && l < cells.layers()) continue;
    blocks.emplace_back();
    blocks.back().grains = begin;
    blocks.back().grains_end = end;
    begin = end;
  }
  return blocks;
}

/// Gathers half of the neighbourhood of a cell besides itself and the next cell: the cell before the first one of a
/// closed row, and the three cells above it in each later row. The cells of a row are contiguous in memory: three are
/// one range, across the seam two. Each pair is found from its earlier grain.
void gather_around(const Cells& cells, const std::vector<std::int32_t>& first, std::int32_t x, std::int32_t y,
                   std::int32_t z, Vicinity& vicinity) {
  const std::int32_t last = cells.row_length() - 1;
  const bool across = cells.rows_close() && last > 1;  // the seam; in shorter rows all cells are neighbours
  const std::int32_t left = std::max(x - 1, 0), right = std::min(x + 1, last);
  const auto gather_row = [&](std::int32_t row_y, std::int32_t row_z) {
    if (row_y < 0 || row_y >= cells.rows() || row_z >= cells.layers()) return;
    const std::int32_t row = (row_z * cells.rows() + row_y) * cells.row_length();
    vicinity.gather(first[row + left], first[row + right + 1]);
    if (across && x == 0) vicinity.gather(first[row + last], first[row + last + 1]);
    if (across && x == last) vicinity.gather(first[row], first[row + 1]);
  };
  if (across && x == 0) {
    const std::int32_t row = (z * cells.rows() + y) * cells.row_length();
    vicinity.gather(first[row + last], first[row + last + 1]);
  }
  gather_row(y + 1, z);
  for (std::int32_t dy = -1; dy <= 1; ++dy) gather_row(y + dy, z + 1);
}

}  // namespace

void rebuild(Particles& particles, const Domain& domain, Pairs& pairs, std::size_t walls, const AttractionReach& reach,
             double skin, FindNear find_near) {
  const std::int32_t n = particles.count();
  if (domain.repeats())
    for (std::int32_t i = 0; i < n; ++i) particles.motion[i].position = domain.put_back(particles.motion[i].position);
  const double largest = largest_of(particles);
  const double farthest =
      std::max({reach.formation_gap, reach.rupture_gap, reach.pull_off_gap}) / reach.reference_radius;
  const Cells cells(particles, domain, 2 * largest + farthest * largest + skin);
  const Sorted sorted = sort_by_cell(particles, cells);
  const std::vector<std::int32_t>& first = sorted.first;
  reorder(particles, sorted.order);
  std::vector<std::int32_t> new_place(n);
  for (std::int32_t k = 0; k < n; ++k) new_place[sorted.order[k]] = k;
  std::vector<Block> old = std::exchange(pairs.blocks, blocks_of(cells, first));
  provide_dummies(particles, pairs.blocks.size());
  for (Block& block : pairs.blocks) block.walls.resize(walls);
  for (std::size_t wall = 0; wall < walls; ++wall) redistribute(old, wall, new_place, pairs.blocks);
  Remembered remembered(old, new_place);
  Vicinity vicinity(particles, domain, farthest, skin, find_near);
  NeighbourList listed;  // copied to the blocks, which allocate no more than they need
  auto block = pairs.blocks.begin();
  std::int32_t cell = 0;
  for (std::int32_t z = 0; z < cells.layers(); ++z)
    for (std::int32_t y = 0; y < cells.rows(); ++y)
      for (std::int32_t x = 0; x < cells.row_length(); ++x, ++cell) {
        if (first[cell] == first[cell + 1]) continue;
        const std::int32_t own_end = first[(x + 1 < cells.row_length() ? cell + 1 : cell) + 1];
        vicinity.clear();
        vicinity.gather(first[cell], own_end);
        gather_around(cells, first, x, y, z, vicinity);
        for (std::int32_t i = first[cell]; i < first[cell + 1]; ++i) {
          if (i == block->grains_end) {
            (block++)->candidates = listed;
            listed.clear();
            remembered.forget_before(i);
            block->contacts.reserve(std::prev(block)->contacts.count);
          }
          remembered.turn_to(i);
          const auto list = [&](std::int32_t j) {
            listed.add(NeighbourList::Pair(j, remembered.recall(i, j, *block)));
          };
          vicinity.find(i, i + 1 - first[cell], list);
          listed.end_grain();
        }
      }
  block->candidates = listed;
}

}  // namespace pastefit
