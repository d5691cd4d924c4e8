#pragma once

#include <optional>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/laws/materials.h"
#include "core/result.h"
#include "core/vec3.h"
#include "core/world/world.h"

namespace pastefit {

/// Grains in a filled, struck-off mould, at rest; or why it could not be filled.
struct Packing {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  double solid_volume_m3 = 0;  ///< of the grains
  double roughness_m = 0;      ///< as struck off: rim less the mean of the closed surface between the tops of grains
  double gap_m = 0;            ///< as struck off: between the mould's side and the grains nearest to it, on average
  RunSummary run;
  std::optional<Failure> failure;
};

/// Drag on a column that comes to rest in its mould [1/s]: without it a soft one swings like a jelly for seconds.
inline constexpr double kColumnDrag = 40;

/// How a mould is filled for a candidate. Tests that differ in the material only, and whose fillings are equal, share
/// their packings.
///
/// Attraction presses soft grains into each other until it is balanced, and a packing made without it would shrink from
/// the mould when it acts. So the mould is filled with smaller grains, by one plus `resting_overlap`: where they touch,
/// the candidate's own grains overlap as much as they will.
struct Filling {
  double friction = 0;           ///< meanwhile: the candidate's, rounded down, since a looser fill would sink
  double resting_overlap = 0;    ///< rounded
  double youngs_modulus_pa = 0;  ///< rounded to half an octave
  auto operator<=>(const Filling&) const = default;
};
Filling filling_of(const SlumpTest& test);

/// Fills and strikes off the mould of `test`: frictional grains without cohesion, as `filling_of` says, grown at random
/// places in mould and hopper and let sink, so that the packing serves all tests with the same mould, grain sizes,
/// density, seed and filling; with `own_fill` under the laws and walls of `test`, for it alone.
std::shared_ptr<const Packing> fill_mould(const SlumpTest& test, const RunOptions& options = {});

/// What is in the mould when it is lifted: the packing at rest under the laws and walls of `test`. All lengths of the
/// column are enlarged (or reduced) until it fills the mould as the packing did, as high and as near to its side: by 2
/// % at most as seen. Its mass is the laboratory's. `run` counts this part only.
Packing full_mould(const SlumpTest& test, const Packing& packing, const RunOptions& options = {});

/// How a column of grains of this mean radius fills a mould.
struct Fit {
  double roughness_m = 0, gap_m = 0;  ///< as in `Packing`
};
Fit fit_of(const Mould& mould, const Particles& grains, double mean_radius);

/// Density at which the packing's grains have the mass that the laboratory's material has in the mould [kg/m^3].
double grain_density(const SlumpTest& test, const Packing& packing);

/// Number of grains that fill mould and hopper: their solid volume over the mean volume of a grain. Some of them are
/// struck off.
double grains_to_fill(const SlumpTest& test);

/// Places of the walls in a slump test's world. The mould is the last one, and is gone after the lift.
inline constexpr std::size_t kTable = 0, kGround = 1, kMould = 2;

inline constexpr double kRestCap = 4;  ///< [s] simulated time a heap is allowed for coming to rest

/// The table, or the plate that can be dropped, on its seat: a square, or a disc where it falls upright.
Shape table_on_seat(const SlumpTest& test);

/// A packing in its mould on the table, under the laws of `test`. Grains that flow over the table's edge land on the
/// ground below it.
World world_in_mould(const SlumpTest& test, const Packing& packing);

}  // namespace pastefit
