#include "calibrate/exports/rolling_spring.h"

#include <cmath>

#include "calibrate/base/format.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"

namespace pastefit {

double rolling_spring_lever(RollingModel rolling, double rolling_friction) {
  return rolling == RollingModel::constant_torque ? 1 : rolling_friction;
}

std::string note_of_constant_torque(const ExportScene& scene, double load) {
  const ContactModel& contact = scene.contact();
  if (contact.rolling != RollingModel::constant_torque || contact.rolling_friction == 0) return {};
  const double radius = 0.5 * scene.radius_m();
  const PairConstants pair = grain_pair(contact, scene.radius_m());
  const double turn = with_law(NormalLaws{}, acting(contact.normal, pair), [&](auto law) {
    const auto normal_force = law.at(pair, std::sqrt(radius), law.overlap_under(pair, radius, load), 1.0);
    return pair.rolling_friction * normal_force.load /
           (2.25 * pair.normal_stiffness * normal_force.contact_radius * radius);
  });
  return format(
      "The card's rolling resistance is a torque of constant size against the spin. In its place stands a spring that "
      "slips at the same moment; two mean grains under %.3g N turn by %.2g rad until it does.",
      load, turn);
}

}  // namespace pastefit
