#include "tests/bench/speed/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/random.h"
#include "core/step/stepper.h"

namespace pastefit {

namespace {

const std::array<Scene, 7> kScenes{{
    {"slump-dry", Container::mould, false, 0, 0, 1000, 5000},
    {"slump-cohesive", Container::mould, true, 0, 0, 1000, 5000},
    {"box-1k", Container::box, false, 1, 1, 100, 20000},
    {"box-10k", Container::box, false, 5, 2, 100, 4000},
    {"box-20k", Container::box, false, 5, 4, 100, 2000},
    {"box-100k", Container::box, false, 10, 10, 100, 500},
    {"box-1m", Container::box, false, 40, 25, 40, 100},
}};

constexpr double kTileSide = 20 * kSceneRadius;  // [m]
constexpr double kTileRest = 1.0;                // [s] in which a tile comes to rest

Wall smooth_wall(Vec3 point, Vec3 normal) {
  Wall wall;
  wall.shape = Plane{point, normal};
  WallContact surface = scene_wall();
  surface.youngs_modulus_pa = 1e14;  // rigid: see fill(Scene)
  surface.friction = surface.rolling_friction = 0;
  wall.pair = wall_pair(scene_material(false), surface, kSceneRadius);
  return wall;
}

/// One tile at rest: grains of a jittered lattice that fell between smooth walls onto a rough floor.
std::vector<Vec3> settled_tile() {
  const double spacing = 2.3 * kSceneRadius, jitter = 0.1 * kSceneRadius;
  const RandomStream place(1, "bench-tile");
  const int across = static_cast<int>(kTileSide / spacing);
  const double margin = 0.5 * (kTileSide - (across - 1) * spacing);
  std::vector<Vec3> centres;
  for (std::uint64_t n = 0; n < kTileGrains; ++n) {
    const int ix = static_cast<int>(n) % across, iy = static_cast<int>(n) / across % across;
    const int iz = static_cast<int>(n) / (across * across);
    centres.push_back({margin + ix * spacing + place.uniform(3 * n, -jitter, jitter),
                       margin + iy * spacing + place.uniform(3 * n + 1, -jitter, jitter),
                       kSceneRadius + iz * spacing + place.uniform(3 * n + 2, 0, jitter)});
  }
  World world;
  world.particles = make_particles(centres, std::vector<double>(centres.size(), kSceneRadius), kGrainDensity);
  set_contact_model(world, scene_material(false), kSceneRadius);
  world.walls = {smooth_wall({}, {1, 0, 0}), smooth_wall({kTileSide, 0, 0}, {-1, 0, 0}), smooth_wall({}, {0, 1, 0}),
                 smooth_wall({0, kTileSide, 0}, {0, -1, 0}), Wall{}};
  world.walls.back().pair = wall_pair(scene_material(false), scene_wall(), kSceneRadius);
  world.walls.back().shape = Plane{};
  Stepper stepper(world, {});
  while (world.time < kTileRest)
    if (const auto problem = stepper.step({})) throw std::runtime_error("bench tile: " + problem->message);
  for (std::int32_t i = 0; i < world.particles.count(); ++i)
    centres[world.particles.identity[i]] = world.particles.motion[i].position;
  return centres;
}

double mirrored(double x, int tile) {
  return tile % 2 == 0 ? tile * kTileSide + x : (tile + 1) * kTileSide - x;
}

Bed fill_box(const Scene& scene) {
  const std::vector<Vec3> tile = settled_tile();
  Bed bed;
  bed.length_m = scene.tiles_x * kTileSide;
  bed.width_m = scene.tiles_y * kTileSide;
  bed.centres.reserve(tile.size() * scene.tiles_x * scene.tiles_y);
  for (int y = 0; y < scene.tiles_y; ++y)
    for (int x = 0; x < scene.tiles_x; ++x)
      for (const Vec3& p : tile) bed.centres.push_back({mirrored(p.x, x), mirrored(p.y, y), p.z});
  return bed;
}

Bed fill_mould_of_scene() {
  SlumpTest test;
  test.mould = scene_mould();
  test.grains.radius_m = kSceneRadius;
  test.contact = scene_material(false);
  test.table_length_m = 2;
  const auto packing = fill_mould(test);
  if (packing->failure) throw std::runtime_error("bench mould: " + packing->failure->message);
  Bed bed;
  bed.centres = packing->centres;
  return bed;
}

}  // namespace

Scene scene_named(std::string_view name) {
  for (const Scene& scene : kScenes)
    if (scene.name == name) return scene;
  throw std::logic_error("no scene of this name");
}

std::vector<std::string_view> scene_names() {
  std::vector<std::string_view> names;
  for (const Scene& scene : kScenes) names.push_back(scene.name);
  return names;
}

Bed fill(const Scene& scene) {
  Bed bed = scene.container == Container::box ? fill_box(scene) : fill_mould_of_scene();
  for (const Vec3& p : bed.centres) bed.top_m = std::max(bed.top_m, p.z + kSceneRadius);
  return bed;
}

ContactModel scene_material(bool cohesive, double radius, double modulus) {
  ContactModel model;
  model.youngs_modulus_pa = modulus;
  model.poissons_ratio = 0.3;
  model.restitution = 0.3;
  model.friction = 0.5;
  model.rolling_friction = 0.1;
  if (!cohesive) return model;
  model.bridge.shape = BridgeShape::polynomial;
  model.bridge.c_n = kBridgeStrength * radius * radius;
  model.bridge.d_c_m = -0.3 * radius;
  model.bridge.b_n_m = model.bridge.c_n / -model.bridge.d_c_m;
  model.bridge.offset_m = 0.15 * radius;
  return model;
}

WallContact scene_wall(double modulus) {
  return {modulus, 0.3, 0.3, 0.5, 0.1, 0.0};
}

Mould scene_mould() {
  return {0.100, 0.065, 0.200};
}

}  // namespace pastefit
