#include "core/laws/materials.h"

namespace pastefit {

GrainSizes enlarged(GrainSizes grains, double k) {
  for (double* length : {&grains.radius_m, &grains.standard_deviation_m, &grains.smallest_m, &grains.largest_m})
    *length *= k;
  return grains;
}

ContactModel enlarged(ContactModel model, double k) {
  Bridge& bridge = model.bridge;
  model.surface_energy_j_m2 *= k;
  bridge.b_n_m *= k;
  bridge.c_n *= k * k;
  bridge.d_c_m *= k;
  bridge.offset_m *= k;
  bridge.liquid_volume_m3 *= k * k * k;
  bridge.surface_tension_n_m *= k;
  if (model.cohesion_n) *model.cohesion_n *= k * k;
  return model;
}

}  // namespace pastefit
