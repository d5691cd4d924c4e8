#pragma once

#include <string>
#include <vector>

namespace pastefit {

/// What a phase of the two-step test takes, a mean over fillings.
struct PhaseCost {
  std::string phase;
  double simulated_s = 0;
  double cpu_s = 0;
};

/// The phases of a scene of the ladders, in order, the fill among them.
std::vector<PhaseCost> phases_of(const std::string& scene, double radius_m, int packings);

}  // namespace pastefit
