#include "core/world/selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "core/world/nearest.h"

namespace pastefit {

namespace {

/// 2 R*/R_ref of two grains.
double size_scale(double r1, double r2, double reference_radius) {
  return 2 * r1 * r2 / ((r1 + r2) * reference_radius);
}

/// Gap at which a contact is torn apart at the latest. It grows less than the size: with its cube root for JKR.
double longest_hold(double pull_off_gap, double size_scale) {
  return pull_off_gap * std::max(size_scale, 1.0);
}

}  // namespace

void Selection::clear() {
  for (ContactList* list : {&contacts, &near}) list->clear();
  bridges.clear();
}

void Selection::pad(std::int32_t dummy) {
  for (ContactList* list : {&contacts, &near}) list->pad(dummy);
  bridges.pad(dummy);
}

Deepest select_pairs(const Particles& particles, const Domain& domain, Block& block, std::int32_t dummy,
                     Selection& chosen, const AttractionReach& reach, const DisplacementBounds& bounds) {
  chosen.clear();
  const bool attracts = reach.rupture_gap > 0;
  const double forming = std::min(reach.formation_gap, reach.rupture_gap);
  // The next of each list, as the candidates come.
  std::array<std::int32_t, NeighbourList::kinds> next{};
  next[NeighbourList::near] = block.contacts.near;
  Deepest deepest;
  const auto choose = [&](NeighbourList::Pair& candidate, std::int32_t i, std::int32_t ahead) {
    __builtin_prefetch(&particles.motion[ahead]);
    __builtin_prefetch(&bounds.way[ahead]);
    const NeighbourList::Kept kept = candidate.kept();
    const std::int32_t j = candidate.grain(), place = next[kept]++;
    const bool contact = kept == NeighbourList::touching || kept == NeighbourList::near;
    const Motion &a = particles.motion[i], &b = particles.motion[j];
    const Vec3 between = domain.minimum_image(a.position, b.position);
    const double square = dot(between, between), touch = a.radius + b.radius;
    double near = touch + bounds.way[i] + bounds.way[j];
    if (reach.pull_off_gap > 0 && contact && block.contacts.touched(place))
      near += longest_hold(reach.pull_off_gap, size_scale(a.radius, b.radius, reach.reference_radius));
    const bool is_near = square < near * near;
    candidate.keep(NeighbourList::nowhere);
    if (!is_near && !attracts) return;
    const float alive = contact                          ? block.contacts.bridge(place)
                        : kept == NeighbourList::nowhere ? 0
                                                         : block.bridges.bridge(place);
    if (!is_near) {
      const double scale = size_scale(a.radius, b.radius, reach.reference_radius);
      const double range = near + (alive > 0 ? reach.rupture_gap : forming) * scale;
      if (square >= range * range) return;
    }
    if (!is_near && !reach.viscous) {
      const double scale = size_scale(a.radius, b.radius, reach.reference_radius);
      candidate.keep(NeighbourList::bridge);
      chosen.bridges.add(i, j, static_cast<float>(scale), alive);
      return;
    }
    Contact pair = contact ? block.contacts.contact(place) : new_contact(particles, i, j);
    pair.bridge = alive;
    const double smaller = std::min(a.radius, b.radius), deeper = touch - deepest.overlap * smaller;
    if (square < deeper * deeper) deepest = {(touch - std::sqrt(square)) / smaller, i};
    const bool met = square < touch * touch || pair.sqrt_contact_radius > 0;
    candidate.keep(met ? NeighbourList::touching : NeighbourList::near);
    (met ? chosen.contacts : chosen.near).add(i, j, pair);
  };
  block.candidates.each(block.grains, choose);
  chosen.pad(dummy);
  // Copied, not swapped: lists that wander from block to block all become as long as the longest.
  block.contacts.join({&chosen.contacts, &chosen.near});
  block.contacts.near = chosen.contacts.count;
  block.bridges.join({&chosen.bridges});
  return deepest;
}

void select_at_wall(const Particles& particles, const Wall& wall, const Block& block, WallContacts& touching,
                    Selection& selection, const AttractionReach& reach, const DisplacementBounds& bounds,
                    double wall_bound) {
  // Both lists are in the order of the grains: one pass merges memory into the new list.
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
      const bool bridged = known && contacts.bridge(old) > 0;
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
