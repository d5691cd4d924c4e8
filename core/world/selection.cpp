#include "core/world/selection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <variant>

#include "core/world/nearest.h"

namespace pastefit {

namespace {

/// 2 R*/R_ref of two grains.
double size_scale(double r1, double r2, double reference_radius) {
  return 2 * r1 * r2 / ((r1 + r2) * reference_radius);
}

/// Largest gap at which a contact separates. It grows less than the size: with its cube root for JKR.
double longest_hold(double pull_off_gap, double size_scale) {
  return pull_off_gap * std::max(size_scale, 1.0);
}

constexpr std::size_t kTogether = sizeof(std::uint64_t);  // candidates tested at a time; distant ones cost nothing

/// History of a candidate, by the list that contains it.
class Recollection {
 public:
  explicit Recollection(const Block& block) {
    const std::span<const ContactBatch> contacts(block.contacts.batches);
    const std::span<const BridgeBatch> bridges(block.bridges.batches);
    for (const auto kept : {NeighbourList::touching, NeighbourList::near})
      if (!contacts.empty()) {
        touched_[kept] = {contacts[0].sqrt_contact_radius, sizeof(ContactBatch) / sizeof(float)};
        alive_[kept] = {contacts[0].bond, sizeof(ContactBatch) / sizeof(float)};
      }
    if (!bridges.empty()) alive_[NeighbourList::bridge] = {bridges[0].bond, sizeof(BridgeBatch) / sizeof(float)};
  }
  bool touched(NeighbourList::Kept kept, std::int32_t place) const { return touched_[kept].at(place) > 0; }
  float bond(NeighbourList::Kept kept, std::int32_t place) const { return alive_[kept].at(place); }
  bool alive(NeighbourList::Kept kept, std::int32_t place) const { return bond(kept, place) > 0; }

 private:
  static constexpr float kNothing[kBatch] = {};
  /// A row of a list's batches.
  struct Row {
    const float* first = kNothing;
    std::size_t stride = 0;
    float at(std::int32_t place) const {
      return first[static_cast<std::uint32_t>(place) / kBatch * stride + static_cast<std::uint32_t>(place) % kBatch];
    }
  };
  std::array<Row, NeighbourList::kinds> touched_, alive_;
};

/// Sorts the candidates into their lists. Without branches, because the list is unpredictable.
void sort_into_lists(Block& block, bool viscous, Selection& chosen) {
  const std::span<NeighbourList::Pair> pairs = block.candidates.pairs();
  const Recollection recollection(block);
  // Next entry of each list, in the order of the candidates, and number of pairs selected for it.
  std::array<std::int32_t, NeighbourList::kinds> next{};
  next[NeighbourList::near] = block.contacts.near;
  std::array<std::size_t, NeighbourList::kinds> count{};
  std::array<ChosenPair*, NeighbourList::kinds> lists{};
  chosen.pairs[NeighbourList::nowhere].resize(1);
  for (std::size_t list = 0; list < lists.size(); ++list) {
    if (list != NeighbourList::nowhere && chosen.pairs[list].size() < pairs.size())
      chosen.pairs[list].resize(pairs.size() + pairs.size() / 8);
    lists[list] = chosen.pairs[list].data();
  }
  const auto choose = [&](std::size_t k, unsigned found) {
    const NeighbourList::Pair pair = pairs[k];
    const NeighbourList::Kept kept = pair.kept();
    const std::int32_t place = next[kept]++;
    const unsigned touched = recollection.touched(kept, place), alive = recollection.alive(kept, place);
    const unsigned met = touched | (found >> nearness::touching & 1);
    const unsigned acts = found >> (nearness::forming + alive) & 1;
    const unsigned near = (found >> nearness::near & 1) | (touched & found >> nearness::held) | (viscous & acts);
    const unsigned list = near * (NeighbourList::near - met) + (1 - near) * acts * NeighbourList::bridge;
    pairs[k] = NeighbourList::Pair(pair.grain(), static_cast<NeighbourList::Kept>(list));
    lists[list][count[list]] = {chosen.first[k], pair, place};
    count[list] += list != NeighbourList::nowhere;
  };
  for (std::size_t first = 0; first < pairs.size(); first += kTogether) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, chosen.nearness.data() + first, kTogether);
    while (bytes != 0) {
      const int bit = std::countr_zero(bytes) / 8 * 8;
      choose(first + bit / 8, static_cast<std::uint8_t>(bytes >> bit));
      bytes &= ~(std::uint64_t{0xFF} << bit);
    }
  }
  chosen.count = count;
}

/// Adds a contact to `fresh` for each pair that has none.
void meet(const Particles& particles, const Recollection& recollection, std::span<ChosenPair> pairs,
          ContactList& fresh) {
  for (ChosenPair& pair : pairs) {
    const NeighbourList::Kept kept = pair.other.kept();
    if (kept == NeighbourList::touching || kept == NeighbourList::near) continue;
    Contact contact = new_contact(particles, pair.i, pair.other.grain());
    contact.bond = recollection.bond(kept, pair.place);
    pair.place = -1 - fresh.count;
    fresh.add(pair.i, pair.other.grain(), contact);
  }
}

}  // namespace

void Selection::clear() {
  contacts.clear();
  fresh.clear();
  fresh.add(0, 0, padding());
  bridges.clear();
}

Deepest select_pairs(const Particles& particles, const Domain& domain, Block& block, std::int32_t dummy,
                     Selection& chosen, const AttractionReach& reach, const DisplacementBounds& bounds,
                     FindNearness find_nearness) {
  chosen.clear();
  const std::span<NeighbourList::Pair> pairs = block.candidates.pairs();
  block.candidates.first_grains(block.grains, chosen.first);
  chosen.nearness.assign((pairs.size() / kTogether + 1) * kTogether, 0);
  const Deepest deepest = find_nearness(
      {particles.motion.data(), bounds.way.data(), chosen.first.data(), pairs, domain, reach, chosen.nearness.data()});
  sort_into_lists(block, reach.viscous, chosen);
  const Recollection recollection(block);
  for (const auto list : {NeighbourList::touching, NeighbourList::near}) {
    meet(particles, recollection, chosen.of(list), chosen.fresh);
    if (list == NeighbourList::near) chosen.contacts.near = chosen.contacts.count;
    chosen.contacts.add(chosen.of(list), block.contacts, chosen.fresh, dummy);
  }
  for (const auto& [i, other, place] : chosen.of(NeighbourList::bridge)) {
    const std::int32_t j = other.grain();
    const double scale = size_scale(particles.motion[i].radius, particles.motion[j].radius, reach.reference_radius);
    chosen.bridges.add(i, j, static_cast<float>(scale), recollection.bond(other.kept(), place));
  }
  chosen.bridges.pad(dummy);
  // Copied, not swapped: lists that move between blocks all become as long as the longest.
  block.contacts.join({&chosen.contacts});
  block.contacts.near = chosen.contacts.near;
  block.bridges.join({&chosen.bridges});
  return deepest;
}

void select_at_wall(const Particles& particles, const Wall& wall, const Block& block, WallContacts& touching,
                    Selection& selection, const AttractionReach& reach, const DisplacementBounds& bounds,
                    double wall_bound) {
  // Both lists are in the order of the grains: one pass copies the history to the new list.
  const ContactList& contacts = touching.contacts;
  ContactList& chosen = selection.at_wall;
  chosen.clear();
  std::int32_t old = 0;
  const double farthest = std::max({wall.pair.rupture_gap, wall.pair.formation_gap, wall.pair.pull_off_gap, 0.0});
  const double slope = 1 + farthest / reach.reference_radius, least = farthest + wall_bound;
  const auto choose = [&](const auto& shape) {
    for (std::int32_t i = block.grains; i < block.grains_end; ++i) {
      const Motion& grain = particles.motion[i];
      if (is_surely_beyond(shape, grain.position, slope * grain.radius + bounds.way[i] + least)) continue;
      while (old < touching.count && contacts.first(old) < i) ++old;
      const bool known = old < touching.count && contacts.first(old) == i;
      const double scale = grain.radius / reach.reference_radius;
      const bool bridged = known && contacts.bond(old) > 0;
      const double gap = bridged ? wall.pair.rupture_gap : std::min(wall.pair.formation_gap, wall.pair.rupture_gap);
      const double hold = known && contacts.touched(old) ? longest_hold(wall.pair.pull_off_gap, scale) : 0.0;
      const double margin = bounds.way[i] + wall_bound;
      const double range = grain.radius + std::max(gap * scale, hold) + margin;
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
