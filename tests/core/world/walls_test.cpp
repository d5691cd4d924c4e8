#include "core/world/walls.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "core/random.h"
#include "core/step/kernels.h"
#include "core/world/contacts.h"
#include "tests/core/scene.h"

using namespace pastefit;

TEST_CASE("the nearest point of a plate is on its face inside and on its edge outside") {
  Plate plate;
  plate.half_length = plate.half_width = 0.5;
  const Nearest above = nearest(plate, {0.2, 0.1, 0.3});
  CHECK(above.distance == Approx(0.3));
  CHECK(above.direction.z == Approx(-1));
  const Nearest beside = nearest(plate, {0.8, 0.1, 0.4});
  CHECK(beside.distance == Approx(0.5));
  CHECK(beside.direction.x == Approx(-0.6));
  CHECK(beside.direction.z == Approx(-0.8));
}

TEST_CASE("a frustum is solid from inside, from outside and at its rims") {
  const Shell shell{{0, 0, 0}, 0.1, 0.065, 0.2};
  const double slope = std::atan2(0.035, 0.2);
  const double half_way = 0.0825;
  const Nearest inside = nearest(shell, {half_way - 0.01 / std::cos(slope), 0, 0.1});
  CHECK(inside.distance == Approx(0.01));
  CHECK(inside.direction.x == Approx(std::cos(slope)));
  CHECK(inside.direction.z == Approx(std::sin(slope)));
  const Nearest outside = nearest(shell, {0, half_way + 0.02 / std::cos(slope), 0.1});
  CHECK(outside.distance == Approx(0.02));
  CHECK(outside.direction.y == Approx(-std::cos(slope)));
  const Nearest under_the_rim = nearest(shell, {0.1, 0, -0.03});
  CHECK(under_the_rim.distance == Approx(0.03));
  CHECK(under_the_rim.direction.z == Approx(1));
}

TEST_CASE("a wall that turns about a hinge carries its points on circles") {
  Wall wall;
  Plate plate;
  plate.half_length = plate.half_width = 0.35;
  wall.shape = plate;
  wall.pivot = {-0.35, 0, 0};
  wall.angular_velocity = {0, -0.1, 0};
  for (int n = 0; n < 1000; ++n) move(wall, 1e-3);
  const Plate& turned = std::get<Plate>(wall.shape);
  CHECK(turned.centre.x == Approx(-0.35 + 0.35 * std::cos(0.1)));
  CHECK(turned.centre.z == Approx(0.35 * std::sin(0.1)));
  CHECK(norm(turned.along) == Approx(1).epsilon(1e-12));
}

TEST_CASE("a grain at rest on any wall carries its weight") {
  ContactModel model;
  model.youngs_modulus_pa = 5e6;
  model.restitution = 0.2;
  const Shape shapes[] = {Plane{}, [] {
                            Plate plate;
                            plate.half_length = plate.half_width = 0.3;
                            return plate;
                          }()};
  for (const Shape& shape : shapes) {
    Scene scene(model);
    scene.world.gravity = kGravity;
    scene.grain({0.05, 0.02, 0.0101}).wall(shape, {});
    scene.run_by_itself(1.0);
    CHECK(scene.world.walls[0].force.z == Approx(-scene.mass(0) * kGravity).epsilon(1e-3));
  }
}

TEST_CASE("two grains that stick overlap as cohesion and Hertz repulsion balance") {
  ContactModel model;
  model.youngs_modulus_pa = 5e6;
  model.restitution = 0.2;
  model.cohesion_n = 0.5;
  Scene scene(model);
  scene.grain({0, 0, 0}).grain({0.01999, 0, 0});
  scene.run_by_itself(1.0);
  const double e_star = 5e6 / (2 * (1 - 0.09));
  const double expected = std::pow(3 * 0.5 / (4 * e_star * std::sqrt(0.005)), 2.0 / 3.0);
  CHECK(0.02 - norm(scene.motion(1).position - scene.motion(0).position) == Approx(expected).epsilon(1e-6));
}

TEST_CASE("a sliding sphere ends up rolling at five sevenths of its speed") {
  ContactModel model;
  model.youngs_modulus_pa = 5e6;
  model.rolling = RollingModel::none;
  Scene scene(model);
  scene.world.gravity = kGravity;
  scene.wall(Plane{}, {1e9, 0.3, 0.3, 0.3, 0, 0});
  const double overlap = 3e-6;
  scene.grain({0, 0, 0.01 - overlap}, {0.1, 0, 0});
  scene.run_by_itself(0.5);
  CHECK(scene.velocity(0).x == Approx(0.1 * 5 / 7).epsilon(2e-3));
}

TEST_CASE("the nearest point of ribs is on the nearest bar: beside it, above it and at its edge") {
  const Ribs standing{{0.1, 0, 0.02}, 0.004, 0.01, 0.05};
  for (const double turns : {0.0, 3.0, -7.0}) {
    const double x = 0.1 + turns * standing.pitch;
    const Nearest beside = nearest(standing, {x + 0.012, 0.3, 0.025});
    CHECK(beside.distance == Approx(0.01));
    CHECK(beside.direction.x == Approx(-1));
    const Nearest above = nearest(standing, {x - 0.001, 0.3, 0.036});
    CHECK(above.distance == Approx(0.006));
    CHECK(above.direction.z == Approx(-1));
    const Nearest at_edge = nearest(standing, {x - 0.005, -0.3, 0.034});
    CHECK(at_edge.distance == Approx(0.005));
    CHECK(at_edge.direction.x == Approx(0.6));
    CHECK(at_edge.direction.z == Approx(-0.8));
  }
  const Ribs hanging{{0, 0, 0.1}, 0.004, -0.01, 0.05};
  const Nearest below = nearest(hanging, {0.05, 0, 0.08});
  CHECK(below.distance == Approx(0.01));
  CHECK(below.direction.z == Approx(1));
  CHECK(nearest(hanging, {0.02, 0, 0.095}).distance == Approx(0.018));
}

namespace {

/// A wall that moves and turns, and 37 grains about it: more than two batches, with padding.
struct NearWall {
  explicit NearWall(const Shape& shape) {
    wall.shape = shape;
    wall.pivot = {-0.3, 0, 0.1};
    wall.velocity_before = {0, 0, 0.1};
    wall.angular_velocity_before = {0, -0.2, 0};
    const RandomStream random(1, "grains near a wall");
    std::vector<Vec3> centres;
    std::vector<double> radii;
    for (std::uint64_t i = 0; i < 37; ++i) {
      const auto at = [&](std::uint64_t k) { return 0.4 * random.uniform(4 * i + k) - 0.2; };
      centres.push_back({at(0), at(1), at(2)});
      radii.push_back(0.005 + 0.01 * random.uniform(4 * i + 3));
    }
    grains = make_particles(centres, radii, 2500);
    for (std::int32_t i = 0; i < grains.count(); ++i) contacts.add(i, i, new_contact(grains, i, i));
    contacts.pad(grains.count());
  }

  std::int32_t found_by(const KernelTable& kernels, Column<WallBatch>& batches) const {
    batches.resize(static_cast<std::size_t>(contacts.batch_count()));
    const WallTask task{grains.motion.data(), contacts.batches.data(), batches.data(), grains.count(), &wall, 0.5};
    return std::visit(
        [&]<class Shape>(const Shape& shape) { return std::get<FindOnWall<Shape>>(kernels.find_on_wall)(task, shape); },
        wall.shape);
  }

  Wall wall;
  Particles grains;
  ContactList contacts;
};

}  // namespace

TEST_CASE("every instruction set finds grains on a wall of any shape where one after the other they are") {
  Plate plate;
  plate.half_length = plate.half_width = 0.15;
  const Shape shapes[] = {Plane{{0, 0, -0.25}, {0, 0, 1}}, plate, Shell{{0, 0, -0.15}, 0.1, 0.05, 0.3},
                          Ribs{{0.01, 0, 0}, 0.002, 0.02, 0.05}};
  for (const KernelTable* kernels : kernels_this_processor_runs())
    for (const Shape& shape : shapes) {
      CAPTURE(kernels->instruction_set, shape.index());
      const NearWall near(shape);
      Column<WallBatch> batches;
      const std::int32_t pierced = near.found_by(*kernels, batches);
      bool some_pierced = false;
      for (std::int32_t k = 0; k < near.grains.count(); ++k) {
        const WallBatch& batch = batches[k / kBatch];
        const int lane = k % kBatch;
        const Motion& grain = near.grains.motion[k];
        const Nearest there = nearest(shape, grain.position);
        const Vec3 arm = grain.position + there.distance * there.direction - near.wall.pivot;
        const Vec3 moving = near.wall.velocity_before + cross(near.wall.angular_velocity_before, arm);
        const auto row = [&](const float(&rows)[3][kBatch]) {
          return Vec3{rows[0][lane], rows[1][lane], rows[2][lane]};
        };
        CHECK(norm(row(batch.normal) - there.direction) < 3e-7);
        CHECK(norm(row(batch.wall_velocity) - moving) < 3e-8);
        CHECK(batch.overlap[lane] == Approx(grain.radius - there.distance).margin(3e-8));
        some_pierced = some_pierced || grain.radius - there.distance > 0.5 * grain.radius;
      }
      CHECK((pierced >= 0) == some_pierced);
      if (pierced >= 0)
        CHECK(nearest(shape, near.grains.motion[pierced].position).distance < 0.5 * near.grains.motion[pierced].radius);
      for (std::int32_t k = near.grains.count(); k < near.contacts.count; ++k)
        CHECK(batches[k / kBatch].overlap[k % kBatch] == -1);
    }
}

TEST_CASE("a grain in the middle of a wall's edge or on its axis has a direction") {
  Plate plate;
  plate.half_length = plate.half_width = 0.5;
  CHECK(std::fabs(nearest(plate, {0.1, 0.1, 0}).direction.z) == Approx(1));
  const Nearest on_axis = nearest(Shell{{0, 0, 0}, 0.1, 0.1, 0.2}, {0, 0, 0.1});
  CHECK(on_axis.distance == Approx(0.1));
  CHECK(norm(on_axis.direction) == Approx(1));
}
