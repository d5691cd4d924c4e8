#include "core/step/state_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/step/kernels.h"
#include "core/step/state.h"

namespace pastefit {

namespace {

constexpr double kFarthest = 1e3;  // [m]; of a grain or a wall from the centre of the table
constexpr double kFastestWall = kRunawaySpeed;
constexpr double kSizeChange = 0.01;  // largest change of a grain's size by its apparatus between two waits

/// Limit for all numbers of a state, in any unit; written so that NaN fails too.
bool is_possible(double value) {
  constexpr double kLargest = 1e15;
  return std::fabs(value) <= kLargest;
}

bool is_possible(const Vec3& v) {
  return is_possible(v.x) && is_possible(v.y) && is_possible(v.z);
}

void demand_within(const Vec3& v, double most, const char* otherwise) {
  demand(is_possible(v) && norm(v) <= most, otherwise);
}

template <std::size_t N>
bool all_possible(const float (&values)[N]) {
  return std::all_of(values, values + N, [](float value) { return is_possible(value); });
}

/// The kind of a shape and its lengths.
std::vector<double> sizes_of(const Shape& shape) {
  struct Sizes {
    std::vector<double> operator()(const Plane&) const { return {0}; }
    std::vector<double> operator()(const Plate& plate) const { return {1, plate.half_length, plate.half_width}; }
    std::vector<double> operator()(const Shell& shell) const {
      return {2, shell.base_radius, shell.top_radius, shell.height};
    }
    std::vector<double> operator()(const Ribs& ribs) const { return {3, ribs.thickness, ribs.height, ribs.pitch}; }
  };
  return std::visit(Sizes{}, shape);
}

std::array<Vec3, 3> places_of(const Shape& shape) {
  struct Places {
    std::array<Vec3, 3> operator()(const Plane& plane) const { return {plane.point, plane.normal, {}}; }
    std::array<Vec3, 3> operator()(const Plate& plate) const { return {plate.centre, plate.along, plate.across}; }
    std::array<Vec3, 3> operator()(const Shell& shell) const { return {shell.base, {}, {}}; }
    std::array<Vec3, 3> operator()(const Ribs& ribs) const { return {ribs.base, {}, {}}; }
  };
  return std::visit(Places{}, shape);
}

/// Grains that may occur in a block's pairs, and the dummies behind all grains.
struct Ends {
  std::int32_t begin, end, next_end, grains, all;
  bool is_dummy(std::int32_t i) const { return i >= grains && i < all; }
};

template <class List>
void check_list(const List& list) {
  demand(list.count >= 0 && list.count % kBatch == 0 &&
             static_cast<std::size_t>(list.batch_count()) == list.batches.size(),
         "a list has another length than it says");
}

template <class List>
void check_grains(const List& list, const Ends& ends) {
  for (std::int32_t k = 0; k < list.count; ++k) {
    const std::int32_t i = list.first(k), j = list.second(k);
    const bool padding = i == j && ends.is_dummy(i);
    const bool pair = i >= ends.begin && i < ends.end && j >= ends.begin && j < ends.next_end && i != j;
    demand(padding || pair, "a pair is of grains that its block does not have");
  }
}

void check_memory(const ContactList& list, std::int32_t k) {
  const Contact contact = list.contact(k);
  const float numbers[] = {contact.sqrt_radius, contact.sqrt_mass,           contact.damper,
                           contact.drag,        contact.sqrt_contact_radius, contact.bond};
  demand(all_possible(numbers) && all_possible(contact.slip) && all_possible(contact.roll), "a contact is not finite");
}

void check_candidates(const Block& block, const Ends& ends) {
  std::array<std::int32_t, NeighbourList::kinds> kept{};
  demand(block.candidates.is_of(ends.end - ends.begin), "the candidates are of other grains");
  block.candidates.each(ends.begin, [&](NeighbourList::Pair pair, std::int32_t) {
    demand(pair.kept() < NeighbourList::kinds && pair.grain() >= ends.begin && pair.grain() < ends.next_end,
           "a candidate is of a grain that its block does not have");
    ++kept[pair.kept()];
  });
  const ContactList& contacts = block.contacts;
  const bool fits = kept[NeighbourList::touching] <= contacts.near &&
                    kept[NeighbourList::near] <= contacts.count - contacts.near &&
                    kept[NeighbourList::bridge] <= block.bridges.count;
  demand(fits, "more candidates are kept than the lists have");
}

void check_wall_contacts(const WallContacts& touching, const Ends& ends) {
  check_list(touching.contacts);
  demand(touching.count >= 0 && touching.count <= touching.contacts.count, "a wall's list has another length");
  for (std::int32_t k = 0; k < touching.contacts.count; ++k) {
    const std::int32_t i = touching.contacts.first(k);
    const bool listed = i >= ends.begin && i < ends.end && (k == 0 || touching.contacts.first(k - 1) < i);
    demand(k < touching.count ? listed : ends.is_dummy(i), "a wall touches grains that its block does not have");
    check_memory(touching.contacts, k);
  }
}

}  // namespace

Fixtures::Grain Fixtures::grain_of(const Particles& particles, std::size_t i) {
  return {particles.motion[i].radius, particles.velocity[i].inverse_mass, particles.velocity[i].inverse_inertia};
}

Fixtures::Fixtures(const World& world) {
  const Particles& particles = world.particles;
  grains_.resize(particles.identity.size());
  for (std::size_t i = 0; i < grains_.size(); ++i)
    grains_.at(static_cast<std::size_t>(particles.identity[i])) = grain_of(particles, i);
  for (const Wall& wall : world.walls) sizes_.push_back(sizes_of(wall.shape));
}

void Fixtures::check(const World& world) const {
  const Particles& particles = world.particles;
  const std::size_t n = grains_.size(), all = particles.motion.size();
  demand(particles.identity.size() == n, "it has another number of grains");
  demand(all > n && particles.velocity.size() == all && particles.load.size() == all,
         "the columns of the grains differ in length");
  std::vector<char> seen(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    const auto identity = static_cast<std::size_t>(particles.identity[i]);
    demand(identity < n && !seen[identity], "a grain stands twice in it");
    seen[identity] = true;
    demand(grain_of(particles, i) == grains_[identity], "a grain has another size or mass");
    // Rounded in every step: an apparatus may have changed the size since.
    const Motion& grain = particles.motion[i];
    demand(std::fabs(grain.rounded_radius - grain.radius) <= kSizeChange * grain.radius, "a grain has two sizes");
    demand_within(particles.motion[i].position, kFarthest, "a grain is not in the laboratory");
    demand_within(particles.velocity[i].linear, kRunawaySpeed, "a grain is faster than any can be");
  }
  for (std::size_t i = 0; i < all; ++i) {
    const Motion& motion = particles.motion[i];
    demand(is_possible(motion.position) && all_possible(motion.velocity) && all_possible(motion.spin) &&
               is_possible(motion.damping_rate) && is_possible(particles.velocity[i].linear) &&
               is_possible(particles.velocity[i].angular),
           "the motion of a grain is not finite");
    const Load& load = particles.load[i];
    demand(all_possible(load.force) && all_possible(load.torque) && is_possible(load.damping) &&
               is_possible(load.stiffness),
           "the load of a grain is not finite");
  }
  for (std::size_t w = 0; w < sizes_.size(); ++w) {
    const Wall& wall = world.walls[w];
    demand(static_cast<double>(wall.shape.index()) == sizes_[w][0] && sizes_of(wall.shape) == sizes_[w],
           "a wall has another shape");
    for (const Vec3& place : places_of(wall.shape)) demand_within(place, kFarthest, "a wall is not in the laboratory");
    for (const Vec3& velocity : {wall.velocity, wall.velocity_before})
      demand_within(velocity, kFastestWall, "a wall is faster than any can be");
    demand(is_possible(wall.angular_velocity) && is_possible(wall.angular_velocity_before) && is_possible(wall.pivot) &&
               is_possible(wall.force) && is_possible(wall.torque),
           "the motion of a wall is not finite");
  }
}

void check_pairs(const World& world, bool listed) {
  const std::vector<Block>& blocks = world.pairs.blocks;
  const auto grains = world.particles.count(), all = static_cast<std::int32_t>(world.particles.motion.size());
  demand(!listed || !blocks.empty() || grains == 0, "it has no blocks");
  demand(blocks.size() + grains <= static_cast<std::size_t>(all), "a block has no dummy");
  std::int32_t begin = 0;
  for (const Block& block : blocks) {
    demand(block.grains == begin && block.grains_end >= begin && block.grains_end <= grains,
           "the blocks do not follow each other");
    begin = block.grains_end;
  }
  demand(blocks.empty() || begin == grains, "the blocks do not hold every grain");
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block& block = blocks[b];
    const Ends ends{block.grains, block.grains_end, blocks[std::min(b + 1, blocks.size() - 1)].grains_end, grains, all};
    check_list(block.contacts);
    check_list(block.bridges);
    const std::int32_t near = block.contacts.near;
    demand(near >= 0 && near <= block.contacts.count && near % kBatch == 0, "the stretches of a list are not in order");
    check_grains(block.contacts, ends);
    check_grains(block.bridges, ends);
    for (std::int32_t k = 0; k < block.contacts.count; ++k)
      check_memory(block.contacts, k);  // padding is computed, too
    for (std::int32_t k = 0; k < block.bridges.count; ++k)
      demand(
          is_possible(block.bridges.bond(k)) && is_possible(block.bridges.batches[k / kBatch].size_scale[k % kBatch]),
          "a bridge is not finite");
    check_candidates(block, ends);
    demand(!listed || block.walls.size() == world.walls.size(), "the blocks know another number of walls");
    for (const WallContacts& touching : block.walls) check_wall_contacts(touching, ends);
  }
}

bool is_in_laboratory(const float (&place)[3]) {
  return std::all_of(place, place + 3, [](float value) { return std::fabs(value) <= kFarthest; });
}

bool are_possible(const EnergySums& energies) {
  return std::ranges::all_of(energies.lane, [](const auto& lanes) {
    return std::ranges::all_of(lanes, [](double value) { return is_possible(value); });
  });
}

bool is_finite(const std::vector<CurvePoint>& points) {
  return std::ranges::all_of(points,
                             [](const CurvePoint& point) { return std::isfinite(point.x) && std::isfinite(point.y); });
}

}  // namespace pastefit
