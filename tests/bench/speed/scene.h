#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/laws/materials.h"
#include "core/vec3.h"

namespace pastefit {

/// What holds the grains of a scene.
enum class Container {
  mould,  ///< the mould of EN 12350-5 on a table; lifted at `kLiftSpeed` while the time is taken
  box     ///< floor and four walls, open above; nothing moves
};

inline constexpr double kLiftSpeed = 0.2;      ///< [m/s]
inline constexpr double kGrainDensity = 2000;  ///< [kg/m^3]
inline constexpr double kSceneStep = 8.75e-5;  ///< [s]: a fifth of the Rayleigh time of these grains
inline constexpr double kSceneRadius = 0.004;  ///< [m]
inline constexpr double kSceneModulus = 5e6;   ///< Young's modulus of grains and walls [Pa]

/// A scene whose steps are timed: the same grains, walls, laws and steps for every engine.
struct Scene {
  std::string name;
  Container container = Container::box;
  bool cohesive = false;
  int tiles_x = 1, tiles_y = 1;  ///< box only: tiles of kTileGrains along x and y
  int warm_steps = 100;          ///< before the clock starts
  int steps = 1000;              ///< timed
};

inline constexpr int kTileGrains = 1000;

/// The scene of this name: slump-dry, slump-cohesive, box-1k, box-10k, box-20k, box-100k, box-1m.
/// Requirement: it is one of `scene_names()`.
Scene scene_named(std::string_view name);
std::vector<std::string_view> scene_names();

/// Grains of a scene at rest and the container's size.
struct Bed {
  std::vector<Vec3> centres;
  double length_m = 0, width_m = 0;  ///< inner sides of the box along x and y
  double top_m = 0;                  ///< of the highest grain
};

/// Fills the scene. Mould: poured, struck off and at rest, about 9,600 grains. Box: one tile of 1,000 grains is settled
/// between smooth walls and mirrored at its walls as often as needed. A mirror image continues a bed at rest exactly:
/// a grain that was pressed against a rigid smooth wall is pressed against its image by the same force. So every box
/// has the same depth, coordination and order, and differs in size only.
/// Errors: throws std::runtime_error if the engine cannot fill it.
Bed fill(const Scene& scene);

/// Contact model of a scene: Hertz-Mindlin, elastic-plastic rolling resistance, and if `cohesive` a bridge that falls
/// in a straight line from c = `kBridgeStrength` R^2 at touch to zero at a gap of 0.3 R, formed when shells of 0.15 R
/// meet.
ContactModel scene_material(bool cohesive, double radius_m = kSceneRadius, double modulus_pa = kSceneModulus);
inline constexpr double kBridgeStrength = 1250;  ///< [Pa]; for grains of 4 mm 3.8 weights of a grain
/// The walls: as the grains, without cohesion.
WallContact scene_wall(double modulus_pa = kSceneModulus);
Mould scene_mould();

}  // namespace pastefit
