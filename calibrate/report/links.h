#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/world/world.h"

namespace pastefit {

/// Interaction of two grains at one time.
struct Link {
  std::int32_t first = 0, second = 0;  ///< indices in the world
  bool touching = false;               ///< otherwise a liquid bridge across a gap
  double overlap_m = 0;                ///< negative: a gap
  double force_n = 0;  ///< normal force of the laws, repulsion positive; without dampers, which depend on the history
};

/// All contacts and existing bridges between grains.
std::vector<Link> links_of(const World& world);

/// Number of touched grains for each grain, by index; 255 includes larger numbers.
std::vector<std::uint8_t> coordination_of(std::span<const Link> links, std::int32_t grains);

/// Tension on each grain: sum over its liquid bridges and its contacts in tension [N].
std::vector<float> pulls_of(std::span<const Link> links, std::int32_t grains);

}  // namespace pastefit
