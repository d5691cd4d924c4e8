#include "core/apparatus/drive.h"

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

void press(const Servo& servo, const std::vector<Wall*>& lid, double kick) {
  double force = servo.load_n;
  for (const Wall* part : lid) force += part->force.z;
  const double damping = std::fabs(servo.load_n) / servo.fastest_m_s;
  const double before = lid.front()->velocity.z;
  const double after = (before + kick * force / servo.mass_kg) / (1 + kick * damping / servo.mass_kg);
  for (Wall* part : lid) part->velocity.z = after;
}

}  // namespace pastefit
