#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/world/world.h"

namespace pastefit {

/// Two grains that act on each other at a moment.
struct Link {
  std::int32_t first = 0, second = 0;  ///< places in the world
  bool touching = false;               ///< else a liquid bridge across a gap
  double overlap_m = 0;                ///< negative: a gap
  double force_n = 0;  ///< of the laws along the normal, repulsion positive; without the dampers, which need the past
};

/// All contacts and living bridges between grains.
std::vector<Link> links_of(const World& world);

/// How many grains each of so many grains touches, by its place in the world; 255 stands for more too.
std::vector<std::uint8_t> coordination_of(std::span<const Link> links, std::int32_t grains);

/// What its neighbours pull on each grain, the sum over its liquid bridges and over contacts in tension [N].
std::vector<float> pulls_of(std::span<const Link> links, std::int32_t grains);

}  // namespace pastefit
