#include "calibrate/report/links.h"

#include <algorithm>
#include <cmath>

#include "core/laws/table.h"

namespace pastefit {

namespace {

/// Force of the laws between two grains at this overlap. `sqrt_contact_radius`: of the contact, 0 if there is none.
double force_of(const World& world, double effective_radius, double overlap, bool touching, double remembered) {
  const PairConstants& pair = world.grain_pair;
  const double scale = pair.size_per_radius * effective_radius;
  if (!touching)
    return with_law(Attractions{}, world.attraction, [&](auto law) {
      if constexpr (law.present)
        return -law.at(pair, std::min(overlap, 0.0), scale).force;
      else
        return 0.0;
    });
  const double normal_force = with_law(NormalLaws{}, acting(world.normal, pair), [&](auto law) {
    return law.at(pair, std::sqrt(effective_radius), overlap, remembered).force;
  });
  return normal_force - pair.cohesion * scale * scale;
}

}  // namespace

std::vector<Link> links_of(const World& world) {
  const Particles& grains = world.particles;
  const bool reaches =
      with_law(NormalLaws{}, acting(world.normal, world.grain_pair), [](auto law) { return law.reaches; });
  const bool yields = with_law(NormalLaws{}, world.normal, [](auto law) { return law.yields; });
  std::vector<Link> links;
  // Separated pairs may still store an old contact; only laws with a range beyond touch use it.
  const auto add = [&](std::int32_t i, std::int32_t j, const Contact& memory) {
    if (i >= grains.count() || j >= grains.count()) return;  // padding
    const Motion &one = grains.motion[i], &other = grains.motion[j];
    const double overlap = one.radius + other.radius - norm(one.position - other.position);
    const double effective_radius = one.radius * other.radius / (one.radius + other.radius);
    const double pull_off_gap = world.grain_pair.pull_off_gap * world.grain_pair.size_per_radius * effective_radius;
    const bool touching = overlap > 0 || (reaches && memory.sqrt_contact_radius > 0 && overlap > -pull_off_gap);
    if (!touching && !(memory.bond > 0)) return;
    const double remembered = yields ? memory.bond : memory.sqrt_contact_radius;
    links.push_back({i, j, touching, overlap, force_of(world, effective_radius, overlap, touching, remembered)});
  };
  for (const Block& block : world.pairs.blocks) {
    const ContactList& contacts = block.contacts;
    for (std::int32_t k = 0; k < contacts.count; ++k) add(contacts.first(k), contacts.second(k), contacts.contact(k));
    for (std::int32_t k = 0; k < block.bridges.count; ++k) {
      const BridgeBatch& batch = block.bridges.batches[k / kBatch];
      Contact bridge;
      bridge.bond = block.bridges.bond(k);
      add(batch.i[k % kBatch], batch.j[k % kBatch], bridge);
    }
  }
  return links;
}

std::vector<std::uint8_t> coordination_of(std::span<const Link> links, std::int32_t grains) {
  std::vector<std::uint8_t> touching(static_cast<std::size_t>(grains), 0);
  for (const Link& link : links)
    for (const std::int32_t grain : {link.first, link.second})
      if (link.touching && touching[grain] < 255) ++touching[grain];
  return touching;
}

std::vector<float> pulls_of(std::span<const Link> links, std::int32_t grains) {
  std::vector<float> pulls(static_cast<std::size_t>(grains), 0);
  for (const Link& link : links)
    for (const std::int32_t grain : {link.first, link.second})
      pulls[grain] += static_cast<float>(std::max(-link.force_n, 0.0));
  return pulls;
}

}  // namespace pastefit
