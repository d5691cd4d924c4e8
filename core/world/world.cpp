#include "core/world/world.h"

namespace pastefit {

void set_contact_model(World& world, const ContactModel& model, double reference_radius) {
  world.reference_radius = reference_radius;
  world.grain_pair = grain_pair(model, reference_radius);
  world.attraction = model.bridge.shape;
  world.rolling = model.rolling;
}

}  // namespace pastefit
