#pragma once

#include "core/apparatus/pellet_crush/pellet_crush.h"
#include "core/apparatus/shear_cell/shear_cell.h"
#include "core/apparatus/specimen.h"

namespace pastefit {

/// Granules of half a millimetre, as soft as those of the granules' papers, that stick by this much.
inline void make_soft_granules(Specimen& test, double surface_energy_j_m2) {
  test.bulk_density_kg_m3 = 1000;
  test.grains.radius_m = 0.0005;
  test.contact.youngs_modulus_pa = 2.4e6;
  test.contact.poissons_ratio = 0.2;
  test.contact.restitution = 0.2;
  test.contact.friction = 0.4;
  test.contact.rolling_friction = 0.01;
  test.contact.rolling = RollingModel::constant_torque;
  test.contact.normal = NormalLaw::jkr;
  test.contact.surface_energy_j_m2 = surface_energy_j_m2;
}

/// Some two hundred of them in a die of six across.
inline PelletCrush small_pellet(double surface_energy_j_m2) {
  PelletCrush test;
  make_soft_granules(test, surface_energy_j_m2);
  test.die_diameter_m = 0.006;
  test.fill_height_m = 0.0075;
  test.pressed_height_m = 0.006;
  return test;
}

/// As many in a cell of six across.
inline ShearCell small_cell(double surface_energy_j_m2) {
  ShearCell test;
  make_soft_granules(test, surface_energy_j_m2);
  test.length_m = 0.006;
  test.width_m = 0.006;
  test.fill_height_m = 0.0065;
  test.lid_ribs = {0.0006, 0.0003, 0.003};
  test.base_ribs = {0.0006, 0.0003, 0.002};
  test.shear_speedup = 500;
  test.final_displacement_m = 0.004;
  return test;
}

}  // namespace pastefit
