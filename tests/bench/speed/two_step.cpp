#include "tests/bench/speed/two_step.h"

#include <cmath>
#include <ctime>
#include <numbers>
#include <stdexcept>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/world/world.h"
#include "tests/bench/speed/peer_files.h"

namespace pastefit {

namespace {

constexpr double kRadius = 0.008;       // [m]
constexpr double kModulus = 2e6;        // [Pa]
constexpr double kRayleighShare = 0.1;  // see the header
constexpr double kRelax = 0.1;          // [s]
constexpr double kRest = 0.5;           // [s]
constexpr double kRaisedRest = 0.3;     // [s]
constexpr double kGroundDepth = 0.1;    // [m] below the table
constexpr double kPoissonsRatio = 0.3;

double solid_volume(const Bed& fill) {
  return static_cast<double>(fill.centres.size()) * 4 / 3 * std::numbers::pi * std::pow(kRadius, 3);
}

double grain_density(const SlumpTest& test, const Bed& fill) {
  return test.bulk_density_kg_m3 * volume_m3(test.mould) / solid_volume(fill);
}

}  // namespace

SlumpTest two_step_test() {
  SlumpTest test;
  test.lift_velocity_m_s = kLiftSpeed;
  test.drop = DropPlate{};
  test.reading.height = HeightReading::highest;
  test.bulk_density_kg_m3 = 1200;  // grains of about 2000
  test.grains.radius_m = kRadius;
  test.contact = scene_material(true, kRadius, kModulus);
  test.mould_wall = test.table_wall = scene_wall(kModulus);
  return test;
}

Bed fill_two_step() {
  const auto packing = fill_mould(two_step_test());
  if (packing->failure) throw std::runtime_error("the mould cannot be filled: " + packing->failure->message);
  Bed bed;
  bed.centres = packing->centres;
  return bed;
}

TestAnswer answer_ours(const Bed& fill) {
  RunOptions options;
  auto packing = std::make_shared<Packing>();
  packing->centres = fill.centres;
  packing->radii.assign(fill.centres.size(), kRadius);
  packing->solid_volume_m3 = solid_volume(fill);
  options.packing = packing;
  const std::clock_t start = std::clock();
  const Outcome outcome = simulate(two_step_test(), options);
  TestAnswer answer;
  answer.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (outcome.failure) throw std::runtime_error("our test failed: " + outcome.failure->message);
  answer.step1_height_mm = outcome.readings.find("step1.height_max_mm").value();
  answer.step2_height_mm = outcome.readings.find("step2.height_max_mm").value();
  return answer;
}

double peer_test_step(const Bed& fill) {
  const double shear = kModulus / (2 * (1 + kPoissonsRatio));
  return kRayleighShare * std::numbers::pi * kRadius * std::sqrt(grain_density(two_step_test(), fill) / shear) /
         (0.163 * kPoissonsRatio + 0.877);
}

Variables test_variables(const Bed& fill, const std::filesystem::path& folder) {
  const SlumpTest test = two_step_test();
  const DropPlate& plate = *test.drop;
  const double step = peer_test_step(fill), density = grain_density(test, fill);
  const double lift_s = test.mould.height_m / test.lift_velocity_m_s;
  const double half = 0.5 * plate.length_m, room = 3 * half;  // for what rolls off the table
  write_grains(folder / "grains.data", fill.centres, kRadius, density,
               {{-room, -room, -1.1 * kGroundDepth}, {room, room, 2 * test.mould.height_m + 0.1}});
  write_mould(folder / "mould.stl", test.mould);
  write_plate(folder / "plate.stl", plate.length_m);

  const double angle = std::asin(plate.lift_height_m / plate.length_m);
  const double acceleration = 1.5 * kGravity * std::cos(angle) / plate.length_m;  // of a bare plate at its hinge
  const auto steps = [&](double seconds) { return std::to_string(std::lround(seconds / step)); };
  const double quarter_steps = std::round(std::sqrt(2 * angle / acceleration) / 4 / step);
  const double raise_steps = std::round(plate.lift_duration_s / step);
  Variables v{{"grains", (folder / "grains.data").string()},
              {"mould", (folder / "mould.stl").string()},
              {"plate", (folder / "plate.stl").string()},
              {"step", decimal(step)},
              {"gravity", decimal(kGravity)},
              {"density", decimal(density)},
              {"radius", decimal(kRadius)},
              {"base_radius", decimal(test.mould.base_radius_m)},
              {"top_radius", decimal(test.mould.top_radius_m)},
              {"height", decimal(test.mould.height_m)},
              {"lift_speed", decimal(test.lift_velocity_m_s)},
              {"relax_steps", steps(kRelax)},
              {"lift_steps", steps(lift_s)},
              {"rest_steps", steps(kRest)},
              {"ground_depth", decimal(kGroundDepth)},
              {"hinge", decimal(half)},
              {"plate_angle", decimal(angle)},
              {"raise_s", decimal(raise_steps * step)},
              {"raise_steps", decimal(raise_steps)},
              {"raised_steps", steps(kRaisedRest)},
              {"fall_steps", decimal(4 * quarter_steps)},
              {"fall_quarter_steps", decimal(quarter_steps)},
              {"fall_rad_s2", decimal(2 * angle / std::pow(4 * quarter_steps * step, 2))},
              {"raise_period", decimal(2 * std::numbers::pi * raise_steps * step / angle)}};
  // A fall at constant acceleration covers 1, 3, 5, 7 sixteenths of the angle in its four quarters.
  for (int part = 1; part <= 4; ++part)
    v.push_back({"fall_period_" + std::to_string(part),
                 decimal(2 * std::numbers::pi * quarter_steps * step / (angle * (2 * part - 1) / 16))});
  return v;
}

}  // namespace pastefit
