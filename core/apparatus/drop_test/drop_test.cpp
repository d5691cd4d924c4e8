#include "core/apparatus/drop_test/drop_test.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/apparatus/field_checker.h"
#include "core/apparatus/impact/approach.h"
#include "core/apparatus/impact/impact.h"
#include "core/laws/constants.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

double speed_after_fall(double height_m) {
  return std::sqrt(2 * kGravity * height_m);
}

/// Height of the ball's centre at touch, for a plate through the origin below it.
double height_at_touch(const DropTest& test, double tilt_rad) {
  return test.grains.radius_m / std::cos(tilt_rad);
}

WallContact same_material(const ContactModel& grains) {
  WallContact plate;
  plate.youngs_modulus_pa = grains.youngs_modulus_pa;
  plate.poissons_ratio = grains.poissons_ratio;
  plate.restitution = grains.restitution;
  plate.friction = grains.friction;
  plate.rolling_friction = grains.rolling_friction;
  plate.cohesion_factor = 1;
  return plate;
}

/// The end of the fall from beyond the reach of attraction, the contact, and the rebound up to the same gap.
Impact end_of_fall(const DropTest& test, double tilt_rad, const RunOptions& options) {
  constexpr double kLeastGap = 0.01, kRoom = 1.01;  // of the radius; over the reach of attraction
  const double radius = test.grains.radius_m;
  const double gap = std::max(kLeastGap * radius, kRoom * rupture_gap(test.contact.bridge, radius));
  const double above_touch = std::min(gap / std::cos(tilt_rad), test.drop_height_m);

  Impact impact;
  impact.contact = test.contact;
  impact.density_kg_m3 = test.bulk_density_kg_m3;
  impact.reference_radius_m = radius;
  impact.gravity_m_s2 = kGravity;
  ImpactGrain ball;
  ball.radius_m = radius;
  ball.centre_m = {0, 0, height_at_touch(test, tilt_rad) + above_touch};
  ball.velocity_m_s = {0, 0, -speed_after_fall(test.drop_height_m - above_touch)};
  impact.grains = {ball};
  ImpactWall plate;
  plate.shape = Plane{{0, 0, 0}, {std::sin(tilt_rad), 0, std::cos(tilt_rad)}};
  plate.surface = same_material(test.contact);
  impact.walls = {plate};
  impact.rebound_gap_m = gap;
  impact.duration_s = 2 * impact_speed_m_s(test) / kGravity;  // longer than any flight of the ball
  if (options.steps.fixed_step_s) {
    impact.step = ImpactStep::fixed;
    impact.step_s = *options.steps.fixed_step_s;
  }
  return impact;
}

/// One drop; `stage`: prefix of its readings.
Outcome drop(const DropTest& test, double tilt_rad, const std::string& stage, const RunOptions& options) {
  const Impact impact = end_of_fall(test, tilt_rad, options);
  Outcome outcome = simulate(impact, options);
  const double contact_s = hertz_contact_time(approach_of_wall(impact, 0, 0), impact_speed_m_s(test));
  outcome.run.advised_step_s = contact_s / Impact{}.steps_per_contact;
  if (outcome.failure) {
    outcome.failure->phase = stage;
    return outcome;
  }
  const Readings& seen = outcome.readings;
  const double touch = height_at_touch(test, tilt_rad), upwards = *seen.find("grain0.velocity_z_m_s");
  double top = seen.find("rebound_top_m").value_or(touch);
  if (upwards > 0) top = std::max(top, *seen.find("grain0.position_z_m") + upwards * upwards / (2 * kGravity));
  Readings readings;
  readings.set(stage + ".rebound_height_mm", 1e3 * std::max(0.0, top - touch));
  if (tilt_rad > 0) readings.set(stage + ".spin_rad_s", *seen.find("grain0.spin_y_rad_s"));
  outcome.readings = readings;
  return outcome;
}

/// Summary of both drops.
RunSummary together(RunSummary one, const RunSummary& next) {
  one.steps += next.steps;
  one.particle_steps += next.particle_steps;
  one.simulated_s += next.simulated_s;
  one.time_step_s = one.simulated_s / static_cast<double>(std::max<std::int64_t>(one.steps, 1));
  one.advised_step_s = std::min(one.advised_step_s, next.advised_step_s);
  one.settled = one.settled && next.settled;
  return one;
}

}  // namespace

double impact_speed_m_s(const DropTest& test) {
  return speed_after_fall(test.drop_height_m);
}

Faults validate(const DropTest& test) {
  FieldChecker check;
  check_specimen(check, test);
  check.require(test.grains.distribution == SizeDistribution::mono, "grains.distribution",
                "is not mono: one ball falls", "give \"mono\" with the radius of the ball");
  check_dimensions(check, test, drop_dimensions);
  return check.take();
}

Outcome simulate(const DropTest& test, const RunOptions& options) {
  Outcome outcome = drop(test, 0, "level", options);
  if (outcome.failure || test.plate_tilt_rad == 0) return outcome;
  const Outcome tilted = drop(test, test.plate_tilt_rad, "tilted", options);
  outcome.run = together(outcome.run, tilted.run);
  outcome.failure = tilted.failure;
  for (const Reading& reading : tilted.readings.all()) outcome.readings.set(reading.name, reading.value);
  return outcome;
}

std::vector<ReadingKind> reading_kinds(const DropTest& test) {
  constexpr int level = 0, tilted = 1;
  constexpr double room = 0.02;  // margin for the accuracy of the apparatus
  constexpr Lack not_tilted{"the plate is not tilted, so the ball falls on a level one only",
                            "leave it out, or give the angle in apparatus.plate_tilt_deg"};
  const double fall_mm = 1e3 * test.drop_height_m;
  const ReadingRange height{0, (1 + room) * fall_mm};
  // A ball that rolls without sliding has 5/7 of v sin t/R; with tangential rebound it has at most twice that.
  const double along_plate_m_s = impact_speed_m_s(test) * std::sin(test.plate_tilt_rad);
  const ReadingRange spin{0, 10.0 / 7 * (1 + room) * along_plate_m_s / test.grains.radius_m};
  // clang-format off
  std::vector<ReadingKind> kinds{
    ReadingKind{.name = "level.rebound_height_mm", .key = "level.rebound_height_mm",
                .measure = "level.rebound_height_mm", .stage = level, .possible = height, .worst_miss = fall_mm,
                .advised = true, .checked = true},
    ReadingKind{.name = "tilted.rebound_height_mm", .key = "tilted.rebound_height_mm",
                .measure = "tilted.rebound_height_mm", .stage = tilted, .possible = height, .worst_miss = fall_mm,
                .advised = true, .checked = true},
    ReadingKind{.name = "tilted.spin_rad_s", .key = "tilted.spin_rad_s", .measure = "tilted.spin_rad_s",
                .stage = tilted, .possible = spin, .worst_miss = spin.largest, .advised = true, .checked = true}};
  // clang-format on
  if (test.plate_tilt_rad == 0)
    for (ReadingKind& kind : kinds)
      if (kind.stage == tilted) kind.lack = not_tilted;
  return kinds;
}

}  // namespace pastefit
