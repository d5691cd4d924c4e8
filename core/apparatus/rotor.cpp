#include "core/apparatus/rotor.h"

#include <cmath>

namespace pastefit {

std::optional<Landing> turn_freely(const Rotor& rotor, Wall& wall, double gravity, double kick, double dt) {
  const Vec3 arm = std::get<Plate>(wall.shape).centre - wall.pivot;
  double& turning = wall.angular_velocity.y;
  turning += kick * (wall.torque.y + arm.x * rotor.mass_kg * gravity) / rotor.inertia_kg_m2;
  const double angle = std::atan2(arm.z, arm.x);
  if (gravity == 0 || turning * dt < angle) return {};
  const Landing landing{angle / turning, turning};
  turning = angle / dt;
  return landing;
}

}  // namespace pastefit
