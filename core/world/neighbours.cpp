#include "core/world/neighbours.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "core/world/cells.h"
#include "core/world/nearest.h"

namespace pastefit {

namespace {

constexpr std::int32_t kGrainsPerBlock =
    2000;  // at least; enough work to be handed to a thread, small enough for a cache

double largest_of(const Particles& particles) {
  double largest = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) largest = std::max(largest, particles.motion[i].radius);
  return largest;
}

/// 2 R*/R_ref of two grains.
double size_scale(double r1, double r2, double reference_radius) {
  return 2 * r1 * r2 / ((r1 + r2) * reference_radius);
}

/// Gap at which a contact is torn apart at the latest. It grows less than the size: with its cube root for JKR.
double longest_hold(double tear_gap, double size_scale) {
  return tear_gap * std::max(size_scale, 1.0);
}

/// Contacts and bridges of the blocks as they were, grouped by the lower index of their grains: found again after the
/// grains have been sorted. A block's lists are given up when the grains they belong to are done with, so that there
/// are never two lists of the whole scene.
class Remembered {
 public:
  Remembered(std::vector<Block>& blocks, const std::vector<std::int32_t>& new_place)
      : blocks_(blocks), last_(blocks.size(), -1), first_(new_place.size() + 1, 0) {
    const auto each = [&](const auto& look) {
      for (std::size_t b = 0; b < blocks.size(); ++b)
        blocks[b].candidates.each(blocks[b].grains, [&](std::int32_t c, std::int32_t i, std::int32_t j) {
          const std::int32_t place = blocks[b].candidates.place(c);
          if (place != Candidates::kNone) look(b, new_place[i], new_place[j], place);
        });
    };
    each([&](std::size_t, std::int32_t i, std::int32_t j, std::int32_t) { ++first_[std::min(i, j) + 1]; });
    for (std::size_t i = 0; i < new_place.size(); ++i) first_[i + 1] += first_[i];
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    known_.resize(first_.back());
    each([&](std::size_t b, std::int32_t i, std::int32_t j, std::int32_t place) {
      const std::int32_t lower = std::min(i, j);
      last_[b] = std::max(last_[b], lower);
      known_[next[lower]++] = {std::max(i, j), place, static_cast<std::int32_t>(b), i > j};
    });
    for (Block& block : blocks) block.candidates = {};
  }

  /// Gives up what belongs to pairs whose lower index is below `grain`.
  void forget_before(std::int32_t grain) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (last_[b] >= grain) continue;
      blocks_[b].contacts = {};
      blocks_[b].bridges = {};
    }
  }

  /// Puts the pair's memory into the block's lists and returns its place there.
  std::int32_t recall(std::int32_t i, std::int32_t j, Block& block) const {
    for (std::int32_t p = first_[i]; p < first_[i + 1]; ++p) {
      const Known& known = known_[p];
      if (known.upper != j) continue;
      const Block& old = blocks_[known.block];
      if (known.place >= 0) {
        const Contact contact = old.contacts.contact(known.place);
        block.contacts.add(i, j, known.turned ? contact.turned() : contact);
        return block.contacts.count - 1;
      }
      block.bridges.add(i, j, 0, old.bridges.bridge(Candidates::bridge_at(known.place)));
      return Candidates::place_of_bridge(block.bridges.count - 1);
    }
    return Candidates::kNone;
  }

 private:
  struct Known {
    std::int32_t upper, place, block;
    bool turned;
  };
  std::vector<Block>& blocks_;
  std::vector<std::int32_t> last_;  ///< by block: the largest lower index among its pairs
  std::vector<std::int32_t> first_;
  std::vector<Known> known_;
};

/// Hands the contacts with a wall over to the blocks in which their grains are now.
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

/// Calls `look(begin, end)` for half of the neighbourhood of a cell's grains besides those of the cell and the one
/// after it: the cell before the first one of a closed row, and the three cells above it in each later row. Cells of a
/// row are neighbours in memory: three are one range, across the seam two. A grain is always looked at by one before
/// it.
template <class Look>
void look_around(const Cells& cells, const std::vector<std::int32_t>& first, std::int32_t x, std::int32_t y,
                 std::int32_t z, const Look& look) {
  const std::int32_t last = cells.row_length() - 1;
  const bool across = cells.rows_close() && last > 1;  // the seam; in shorter rows all are beside each other
  const std::int32_t left = std::max(x - 1, 0), right = std::min(x + 1, last);
  const auto look_row = [&](std::int32_t row_y, std::int32_t row_z) {
    if (row_y < 0 || row_y >= cells.rows() || row_z >= cells.layers()) return;
    const std::int32_t row = (row_z * cells.rows() + row_y) * cells.row_length();
    look(first[row + left], first[row + right + 1]);
    if (across && x == 0) look(first[row + last], first[row + last + 1]);
    if (across && x == last) look(first[row], first[row + 1]);
  };
  if (across && x == 0) {
    const std::int32_t row = (z * cells.rows() + y) * cells.row_length();
    look(first[row + last], first[row + last + 1]);
  }
  look_row(y + 1, z);
  for (std::int32_t dy = -1; dy <= 1; ++dy) look_row(y + dy, z + 1);
}

}  // namespace

void Candidates::clear() {
  ends_.clear();
  second_.clear();
  place_.clear();
}

void Candidates::add(std::int32_t j, std::int32_t place) {
  second_.push_back(j);
  place_.push_back(place);
}

void rebuild(Particles& particles, const Domain& domain, Pairs& pairs, std::size_t walls, const AttractionReach& reach,
             double skin) {
  const std::int32_t n = particles.count();
  if (domain.repeats())
    for (std::int32_t i = 0; i < n; ++i) particles.motion[i].position = domain.put_back(particles.motion[i].position);
  const double largest = largest_of(particles);
  const double farthest = std::max({reach.formation_gap, reach.rupture_gap, reach.tear_gap}) / reach.reference_radius;
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
  Candidates listed;  // copied to the blocks, which take no more memory than they need
  auto block = pairs.blocks.begin();
  const auto look = [&](std::int32_t i, std::int32_t begin, std::int32_t end) {
    const Motion& a = particles.motion[i];
    const double widest = a.radius + largest + farthest * 2 * a.radius * largest / (a.radius + largest) + skin;
    for (std::int32_t j = begin; j < end; ++j) {
      const Motion& b = particles.motion[j];
      const Vec3 between = domain.way(a.position, b.position);
      if (dot(between, between) >= widest * widest) continue;
      const double range = a.radius + b.radius + farthest * 2 * a.radius * b.radius / (a.radius + b.radius) + skin;
      if (dot(between, between) >= range * range) continue;
      listed.add(j, remembered.recall(i, j, *block));
    }
  };
  std::int32_t cell = 0;
  for (std::int32_t z = 0; z < cells.layers(); ++z)
    for (std::int32_t y = 0; y < cells.rows(); ++y)
      for (std::int32_t x = 0; x < cells.row_length(); ++x, ++cell) {
        const std::int32_t next = x + 1 < cells.row_length() ? cell + 1 : cell;
        for (std::int32_t i = first[cell]; i < first[cell + 1]; ++i) {
          if (i == block->grains_end) {
            (block++)->candidates = listed;
            listed.clear();
            remembered.forget_before(i);
            block->contacts.reserve(std::prev(block)->contacts.count);
          }
          look(i, i + 1, first[next + 1]);
          look_around(cells, first, x, y, z, [&](std::int32_t begin, std::int32_t end) { look(i, begin, end); });
          listed.end_grain();
        }
      }
  block->candidates = listed;
}

void Selection::clear() {
  for (ContactList* list : {&contacts, &near, &dormant}) list->clear();
  for (BridgeList* list : {&bridges, &dormant_bridges}) list->clear();
  near_candidates.clear();
  dormant_candidates.clear();
}

void Selection::pad(std::int32_t dummy) {
  for (ContactList* list : {&contacts, &near, &dormant}) list->pad(dummy);
  for (BridgeList* list : {&bridges, &dormant_bridges}) list->pad(dummy);
}

Deepest select_pairs(const Particles& particles, const Domain& domain, Block& block, std::int32_t dummy,
                     Selection& chosen, const AttractionReach& reach, const Leeway& leeway) {
  Candidates& candidates = block.candidates;
  chosen.clear();
  const double forming = std::min(reach.formation_gap, reach.rupture_gap);
  Deepest deepest;
  const auto choose = [&](std::int32_t c, std::int32_t i, std::int32_t j) {
    const std::int32_t place = candidates.place(c), ahead = candidates.ahead(c);
    __builtin_prefetch(&particles.motion[ahead]);
    __builtin_prefetch(&leeway.rooms[ahead]);
    __builtin_prefetch(&leeway.own[ahead]);
    const Motion &a = particles.motion[i], &b = particles.motion[j];
    const Vec3 between = domain.way(a.position, b.position);
    const double square = dot(between, between), touch = a.radius + b.radius;
    const bool contact = place >= 0;
    const float alive = contact                     ? block.contacts.bridge(place)
                        : place < Candidates::kNone ? block.bridges.bridge(Candidates::bridge_at(place))
                                                    : 0;
    double near = touch + leeway.rooms[i].distance + leeway.rooms[j].distance;
    if (reach.tear_gap > 0 && contact && block.contacts.touched(place))
      near += longest_hold(reach.tear_gap, size_scale(a.radius, b.radius, reach.reference_radius));
    const bool dormant = leeway.own[i] == 0 && leeway.own[j] == 0;
    if (square >= near * near) {
      const double scale = size_scale(a.radius, b.radius, reach.reference_radius);
      const double range = near + (alive > 0 ? reach.rupture_gap : forming) * scale;
      candidates.set_place(c, Candidates::kNone);
      if (square >= range * range) return;
      if (dormant) {
        chosen.dormant_candidates.push_back(c);
        candidates.set_place(c, Candidates::place_of_bridge(chosen.dormant_bridges.count));
        chosen.dormant_bridges.add(i, j, static_cast<float>(scale), alive);
        return;
      }
      candidates.set_place(c, Candidates::place_of_bridge(chosen.bridges.count));
      chosen.bridges.add(i, j, static_cast<float>(scale), alive);
      return;
    }
    Contact pair = contact ? block.contacts.contact(place) : new_contact(particles, i, j);
    pair.bridge = alive;
    if (square < touch * touch) {
      const double overlap = (touch - std::sqrt(square)) / std::min(a.radius, b.radius);
      if (overlap > deepest.overlap) deepest = {overlap, i};
    }
    if (dormant) {
      candidates.set_place(c, chosen.dormant.count);
      chosen.dormant.add(i, j, pair);
      chosen.dormant_candidates.push_back(c);
      return;
    }
    if (square >= touch * touch && pair.root_contact_radius == 0) {
      candidates.set_place(c, chosen.near.count);
      chosen.near.add(i, j, pair);
      chosen.near_candidates.push_back(c);
      return;
    }
    candidates.set_place(c, chosen.contacts.count);
    chosen.contacts.add(i, j, pair);
  };
  candidates.each(block.grains, choose);
  chosen.pad(dummy);
  const std::int32_t near = chosen.contacts.count, awake = near + chosen.near.count;
  for (const std::int32_t c : chosen.near_candidates) candidates.set_place(c, near + candidates.place(c));
  for (const std::int32_t c : chosen.dormant_candidates) {
    const std::int32_t place = candidates.place(c);
    candidates.set_place(c, place >= 0 ? awake + place : place - chosen.bridges.count);
  }
  // Copied, not swapped: lists that wander from block to block all become as long as the longest.
  block.contacts.join({&chosen.contacts, &chosen.near, &chosen.dormant});
  block.contacts.near = near;
  block.contacts.awake = awake;
  block.bridges.join({&chosen.bridges, &chosen.dormant_bridges});
  block.bridges.awake = chosen.bridges.count;
  return deepest;
}

void select_at_wall(const Particles& particles, const Wall& wall, const Block& block, WallContacts& touching,
                    Selection& selection, const AttractionReach& reach, const Leeway& leeway, double wall_leeway) {
  // Both lists are in the order of the grains: one pass merges memory into the new list.
  const ContactList& contacts = touching.contacts;
  ContactList& chosen = selection.at_wall;
  chosen.clear();
  std::int32_t old = 0;
  const auto choose = [&](const auto& shape) {
    for (std::int32_t i = block.grains; i < block.grains_end; ++i) {
      while (old < touching.count && contacts.first(old) < i) ++old;
      const bool known = old < touching.count && contacts.first(old) == i;
      const Motion& grain = particles.motion[i];
      const double scale = grain.radius / reach.reference_radius;
      const bool bridged = known && contacts.bridge(old) > 0;
      const double gap = bridged ? wall.pair.rupture_gap : std::min(wall.pair.formation_gap, wall.pair.rupture_gap);
      const double hold = known && contacts.touched(old) ? longest_hold(wall.pair.tear_gap, scale) : 0.0;
      const double margin = leeway.rooms[i].distance + wall_leeway;
      const double range = grain.radius + std::max(gap * scale, hold) + margin;
      if (is_surely_beyond(shape, grain.position, range)) continue;
      if (nearest_on(shape, grain.position).distance >= range) continue;
      chosen.add(i, i, known ? contacts.contact(old) : new_contact(particles, i, i));
    }
  };
  std::visit(choose, wall.shape);
  touching.count = chosen.count;
  chosen.pad(particles.count());
  touching.contacts.join({&chosen});
}

}  // namespace pastefit
