#include "core/world/world.h"

namespace pastefit {

void set_contact_model(World& world, const ContactModel& model, double reference_radius) {
  world.reference_radius = reference_radius;
  world.grain_pair = grain_pair(model, reference_radius);
  world.normal = model.normal;
  world.attraction = model.bridge.shape;
  world.rolling = model.rolling;
}

void turn_half_round(World& world) {
  const auto turn = [](auto& x, auto& y) {
    x = -x;
    y = -y;
  };
  for (std::int32_t i = 0; i < world.particles.count(); ++i) {
    Motion& motion = world.particles.motion[i];
    Velocity& velocity = world.particles.velocity[i];
    turn(motion.position.x, motion.position.y);
    turn(motion.velocity[0], motion.velocity[1]);
    turn(motion.spin[0], motion.spin[1]);
    turn(velocity.linear.x, velocity.linear.y);
    turn(velocity.angular.x, velocity.angular.y);
  }
  const auto turn_memory = [&](ContactList& list) {
    for (std::int32_t b = 0; b < list.batch_count(); ++b)
      for (int lane = 0; lane < kBatch; ++lane) {
        ContactBatch& batch = list.batches[b];
        turn(batch.slip[0][lane], batch.slip[1][lane]);
        turn(batch.roll[0][lane], batch.roll[1][lane]);
      }
  };
  for (Block& block : world.pairs.blocks) {
    turn_memory(block.contacts);
    for (WallContacts& wall : block.walls) turn_memory(wall.contacts);
  }
}

}  // namespace pastefit
