#include "core/apparatus/servo.h"

#include <cmath>

namespace pastefit {

void press(const Servo& servo, const std::vector<Wall*>& lid, double kick) {
  double force = servo.load_n;
  for (const Wall* part : lid) force += part->force.z;
  const double damping = std::fabs(servo.load_n) / servo.fastest_m_s;
  const double before = lid.front()->velocity.z;
  const double after = (before + kick * force / servo.mass_kg) / (1 + kick * damping / servo.mass_kg);
  for (Wall* part : lid) part->velocity.z = after;
}

}  // namespace pastefit
