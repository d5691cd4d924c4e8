#include "surfaces.h"

#include <algorithm>
#include <cmath>

#include "core/laws/contact.h"
#include "core/laws/table.h"
#include "words.h"

namespace pastefit_lammps {

using namespace pastefit;

static_assert(sizeof(History) == kHistoryNumbers * sizeof(double));

namespace {

constexpr Range kPositive{0, largest_quantity, true};

void require(Words& words, bool good, const char* fault) {
  if (!good) words.fault(fault);
}

void check_surface(Words& words, double youngs_modulus, double poissons_ratio, double restitution, double friction,
                   double rolling_friction) {
  require(words, youngs_modulus > 0, "'youngs_modulus_pa' is to be above 0");
  require(words, poissons_ratio >= 0 && poissons_ratio < 0.5, "'poissons_ratio' is to be 0 to below 0.5");
  require(words, restitution > 0 && restitution <= 1, "'restitution' is to be above 0, at most 1");
  require(words, friction >= 0, "'friction' is to be 0 or more");
  require(words, rolling_friction >= 0, "'rolling_friction' is to be 0 or more");
}

void check_bridge(Words& words, const Bridge& bridge) {
  if (bridge.shape == BridgeShape::none) return;
  require(words, bridge.offset_m >= 0, "'bridge.offset_m' is to be 0 or more");
  require(words, bridge.viscosity_pa_s >= 0, "'bridge.viscosity_pa_s' is to be 0 or more");
  if (bridge.shape == BridgeShape::capillary) {
    require(words, bridge.liquid_volume_m3 > 0, "'bridge.liquid_volume_m3' is to be above 0");
    require(words, bridge.surface_tension_n_m >= 0, "'bridge.surface_tension_n_m' is to be 0 or more");
    require(words, bridge.contact_angle_rad >= 0 && bridge.contact_angle_rad < 1.5708,
            "'bridge.contact_angle_rad' is to be 0 to below pi/2");
  } else {
    require(words, bridge.c_n >= 0, "'bridge.c_n' is to be 0 or more");
    require(words, bridge.d_c_m < 0, "'bridge.d_c_m', an overlap, is to be below 0");
  }
}

template <class Normal, class Attraction, class Rolling, bool viscous>
pastefit::ContactForce<double> kernel(const PairConstants& pair, const ContactKinematics<double>& kinematics,
                                      History& history, double dt) {
  return act<Normal, Attraction, Rolling, viscous>(pair, kinematics, history, dt, Energies::none);
}

}  // namespace

std::string read_law(const std::vector<std::string>& all, Law& law) {
  Words words(all);
  words.number("reference_radius_m", law.reference_radius_m, kPositive, Need::required);
  describe_contact(words, law.grains);
  const ContactModel& grains = law.grains;
  check_surface(words, grains.youngs_modulus_pa, grains.poissons_ratio, grains.restitution, grains.friction,
                grains.rolling_friction);
  require(words, grains.surface_energy_j_m2 >= 0, "'surface_energy_j_m2' is to be 0 or more");
  require(words, grains.cohesion_energy_density_pa >= 0, "'cohesion_energy_density_pa' is to be 0 or more");
  require(words, grains.plasticity_ratio >= 0 && grains.plasticity_ratio <= kMostPlastic,
          "'plasticity_ratio' is to be 0 to 0.98");
  require(words, grains.adhesion_ratio >= 0 && grains.adhesion_ratio <= kMostAdhesive,
          "'adhesion_ratio' is to be 0 to 20");
  require(words, go_together(grains.normal, grains.bridge.shape), "this 'normal' goes beside no bridge");
  check_bridge(words, grains.bridge);
  return words.faults();
}

std::string read_wall(const std::vector<std::string>& all, WallContact& wall) {
  Words words(all);
  describe_wall(words, wall);
  check_surface(words, wall.youngs_modulus_pa, wall.poissons_ratio, wall.restitution, wall.friction,
                wall.rolling_friction);
  require(words, wall.cohesion_factor >= 0, "'cohesion_factor' is to be 0 or more");
  return words.faults();
}

std::string read_hinge(const std::vector<std::string>& all, Hinge& hinge) {
  Words words(all);
  words.number("mass_kg", hinge.mass_kg, kPositive, Need::required);
  words.number("inertia_kg_m2", hinge.inertia_kg_m2, kPositive, Need::required);
  words.number("arm_m", hinge.arm_m, {0, 1000}, Need::required);
  words.number("x_m", hinge.x_m, {-1000, 1000}, Need::required);
  words.number("z_m", hinge.z_m, {-1000, 1000}, Need::required);
  words.number("angle_rad", hinge.angle_rad, {-1.5707, 0}, Need::required);
  return words.faults();
}

Surfaces::Surfaces(const Law& law) : Surfaces(law.grains, grain_pair(law.grains, law.reference_radius_m)) {}

Surfaces::Surfaces(const Law& law, const WallContact& wall)
    : Surfaces(law.grains, wall_pair(law.grains, wall, law.reference_radius_m)) {}

Surfaces::Surfaces(const ContactModel& grains, const PairConstants& pair) : pair_(pair) {
  const BridgeShape shape = pair.rupture_gap > 0 ? grains.bridge.shape : BridgeShape::none;
  with_law(NormalLaws{}, acting(grains.normal, pair), [&](auto normal) {
    with_law(Attractions{}, shape, [&](auto attraction) {
      with_law(RollingLaws{}, grains.rolling, [&](auto rolling) {
        using Normal = decltype(normal);
        using Attraction = decltype(attraction);
        using Rolling = decltype(rolling);
        if constexpr (go_together(Normal{}, Attraction{})) {
          kernel_ = &kernel<Normal, Attraction, Rolling, false>;
          if constexpr (Attraction::present)
            if (pair.viscosity > 0) kernel_ = &kernel<Normal, Attraction, Rolling, true>;
        }
      });
    });
  });
}

double Surfaces::reach(double effective_radius) const {
  const double scale = pair_.size_per_radius * effective_radius;
  return std::max(pair_.rupture_gap * scale, pair_.pull_off_gap * std::max(scale, 1.0));
}

Reaction Surfaces::act(const Meeting& meeting, History& history, double dt, bool stands) const {
  const double scale = pair_.size_per_radius * meeting.radius;
  if (meeting.overlap <= 0 && is_empty(history) && -meeting.overlap > pair_.formation_gap * scale) return {};
  ContactKinematics<double> kinematics{
      meeting.normal,         meeting.overlap,           meeting.velocity,        meeting.spin,     meeting.twist,
      meeting.smaller_radius, std::sqrt(meeting.radius), std::sqrt(meeting.mass), 1 / meeting.mass, 0};
  if (stands) {
    // The kernel adds the way of a step to the springs: what it will add is taken away before.
    const Vec3 &velocity = meeting.velocity, &spin = meeting.spin, &normal = meeting.normal;
    history.slip = history.slip - dt * (velocity - dot(velocity, normal) * normal);
    history.roll = history.roll - dt * (spin - dot(spin, normal) * normal);
    kinematics.twist = 0;
  }
  const ContactForce<double> contact_force = kernel_(pair_, kinematics, history, dt);
  return {contact_force.tangential_force - contact_force.normal_force * meeting.normal, contact_force.tangential_force,
          contact_force.moment};
}

}  // namespace pastefit_lammps
