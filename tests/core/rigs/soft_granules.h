#pragma once

#include "core/rigs/specimen.h"

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

}  // namespace pastefit
