#include "core/rigs/pellet_crush/pellet_crush.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/laws/constants.h"
#include "core/rigs/field_checker.h"

namespace pastefit {

namespace {

constexpr double kGranulesAcross = 6;  // a pellet of fewer says nothing about a continuum
constexpr double kQuasiStatic = 0.1;   // of the speed of sound: beyond it a wall throws granules
constexpr double kMostStrain = 0.8;

void check_speed(FieldChecker& check, const char* where, const char* what, double speed, double sound,
                 const char* remedy) {
  check.require(!(speed > kQuasiStatic * sound), where,
                std::string(what) + " moves at " + FieldChecker::text(speed) +
                    " m/s, but sound in a bed of these granules at " + FieldChecker::text(sound) + " m/s only",
                std::string(remedy) + ": at most " + FieldChecker::text(kQuasiStatic * sound) +
                    " m/s, a tenth of it; or give stiffer granules");
}

}  // namespace

double area_m2(const PelletCrush& test) {
  return 0.25 * std::numbers::pi * test.die_diameter_m * test.die_diameter_m;
}

double filled_volume_m3(const PelletCrush& test) {
  return area_m2(test) * test.fill_height_m;
}

double sound_speed_m_s(const Specimen& granules) {
  constexpr double kOverlap = 0.01;  // of the diameter
  const double radius = granules.grains.radius_m;
  const double stiffness =
      grain_pair(granules.contact, radius).normal_stiffness * std::sqrt(0.5 * radius * kOverlap * 2 * radius);
  const double mass = granules.bulk_density_kg_m3 * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
  return 2 * radius * std::sqrt(stiffness / mass);
}

Faults validate(const PelletCrush& test) {
  FieldChecker check;
  check_specimen(check, test);
  check.range("die_diameter_m", test.die_diameter_m, 1e-4, 1, "m");
  check.range("fill_height_m", test.fill_height_m, 1e-4, 1, "m");
  check.range("pressed_height_m", test.pressed_height_m, 1e-4, 1, "m");
  check.range("pour_speed_m_s", test.pour_speed_m_s, 1e-3, 10, "m/s");
  check.range("punch_speed_m_s", test.punch_speed_m_s, 1e-7, 10, "m/s");
  check.range("press_speedup", test.press_speedup, 1, 1e6, "");
  check.range("platen_speed_m_s", test.platen_speed_m_s, 1e-4, 10, "m/s");
  check.range("final_strain", test.final_strain, 0.01, kMostStrain, "");
  check.require(test.pressed_height_m <= test.fill_height_m, "pressed_height_m",
                "is above the fill height: the punch would press nothing", "give pressed height <= fill height");
  const double largest = largest_radius(test.grains);
  const double narrow = std::min(test.die_diameter_m, test.pressed_height_m);
  check.require(narrow >= 2 * kGranulesAcross * largest, "grains.radius_m",
                "is " + FieldChecker::text(largest) + " m (largest), but the pellet is only " +
                    FieldChecker::text(narrow) + " m across: one of a few granules says nothing about a continuum",
                "take granules of at most " + FieldChecker::text(narrow / (2 * kGranulesAcross)) + " m radius");
  if (largest > 0 && test.contact.youngs_modulus_pa > 0 && test.bulk_density_kg_m3 > 0) {
    const double sound = sound_speed_m_s(test);
    check_speed(check, "press_speedup", "the punch", test.press_speedup * test.punch_speed_m_s, sound,
                "give a slower punch or a smaller press_speedup");
    check_speed(check, "platen_speed_m_s", "the platen", test.platen_speed_m_s, sound, "give a slower platen");
  }
  check_wall(check, test.tools, "tools");
  return check.take();
}

}  // namespace pastefit
