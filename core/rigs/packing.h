#pragma once

#include <optional>
#include <vector>

#include "core/result.h"
#include "core/rigs/materials.h"
#include "core/rigs/slump_table.h"
#include "core/simulate.h"
#include "core/vec3.h"

namespace pastefit {

/// Grains in a filled, struck-off mould, at rest; or why it could not be filled.
struct Packing {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  double solid_volume_m3 = 0;  ///< of the grains
  RunSummary run;
  std::optional<Failure> failure;
};

/// Number of grains that are poured to fill the mould: its volume times the share of it that is poured as solid, over
/// the mean volume of a grain. Some of them are struck off.
double poured_grains(const SlumpTable& test);

/// Radius of grain n of a scene, from the stream "grain-radius". Pure function of its arguments.
double draw_radius(const GrainSizes& sizes, std::uint64_t seed, std::uint64_t n);

}  // namespace pastefit
