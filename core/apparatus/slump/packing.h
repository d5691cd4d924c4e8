#pragma once

#include <optional>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/laws/materials.h"
#include "core/result.h"
#include "core/vec3.h"
#include "core/world/world.h"

namespace pastefit {

/// Grains at rest in a filled, struck-off mould; or the reason why filling failed.
struct Packing {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  double solid_volume_m3 = 0;  ///< of the grains
  double roughness_m = 0;  ///< after striking off: rim minus the mean of the closed surface between the tops of grains
  double gap_m = 0;        ///< after striking off: mean distance between the mould's side and the grains nearest to it
  RunSummary run;
  std::optional<Failure> failure;
};

/// Drag on a column that comes to rest in its mould [1/s]; without it a soft column oscillates for seconds.
inline constexpr double kColumnDrag = 40;

/// How a mould is filled for a candidate. Tests that differ only in the material and have equal fillings share
/// packings.
///
/// Attraction presses soft grains into each other, so a packing made without it would shrink away from the mould.
/// Therefore the mould is filled with grains that are smaller by a factor 1 + `resting_overlap`: at touch, the
/// candidate's full-size grains have their equilibrium overlap.
struct Filling {
  double friction = 0;           ///< during filling: the candidate's, rounded down, since a looser fill would sink
  double resting_overlap = 0;    ///< rounded
  double youngs_modulus_pa = 0;  ///< rounded to half an octave
  auto operator<=>(const Filling&) const = default;
};
Filling filling_of(const SlumpTest& test);

/// Fills and strikes off the mould of `test`: frictional grains without cohesion (`filling_of`) grow at random places
/// in mould and hopper and sink. The packing serves all tests with the same mould, grain sizes, density, seed and
/// filling; with `own_fill` it is made under the laws and walls of `test`, for it alone.
std::shared_ptr<const Packing> fill_mould(const SlumpTest& test, const RunOptions& options = {});

/// The content of the mould before the lift: the packing at rest under the laws and walls of `test`. All lengths of the
/// column are scaled until it fills the mould as the packing did, equally high and equally near to its side; changes of
/// up to 2 % were observed. Its mass is the measured one. `run` counts this part only.
Packing full_mould(const SlumpTest& test, const Packing& packing, const RunOptions& options = {});

/// How well a column of grains of this mean radius fills a mould.
struct Fit {
  double roughness_m = 0, gap_m = 0;  ///< as in `Packing`
};
Fit fit_of(const Mould& mould, const Particles& grains, double mean_radius);

/// Density of a grain at which the packing has the mass of the material in the mould [kg/m^3].
double grain_density(const SlumpTest& test, const Packing& packing);

/// Number of grains that fill mould and hopper: their solid volume over the mean volume of a grain. Some are struck
/// off.
double grains_needed(const SlumpTest& test);

/// Indices of the walls in a slump test's world. The mould is the last one and is removed after the lift.
inline constexpr std::size_t kTable = 0, kGround = 1, kMould = 2;

inline constexpr double kRestCap = 4;  ///< [s] simulated time allowed for a heap to come to rest

/// The table, or the drop plate on its seat: a square, or a disc if it falls vertically.
Shape table_on_seat(const SlumpTest& test);

/// A packing in its mould on the table, under the laws of `test`. Grains that flow over the table's edge land on the
/// ground below.
World world_in_mould(const SlumpTest& test, const Packing& packing);

}  // namespace pastefit
