#include "contact_law.h"

#include <algorithm>
#include <cmath>

namespace pastefit_lammps {

namespace {

const double kPi = std::acos(-1.0);
const double kPassage = 0.01;    // of the reference radius
const double kRoughness = 0.02;  // of the reference radius

double damping_ratio(double restitution) {
  const double ln = std::log(restitution);
  return -ln / std::sqrt(ln * ln + kPi * kPi);
}

double shear_modulus(double youngs_modulus, double poissons_ratio) {
  return youngs_modulus / (2 * (1 + poissons_ratio));
}

/// A vector of the contact plane, carried along with the contact: into the plane as it is now, turned by `angle`, as
/// long as it was.
Vector carried(const Vector& v, const Vector& normal, double angle) {
  const Vector flat = v - dot(v, normal) * normal;
  const Vector turned = flat + angle * cross(normal, flat);
  const double length = norm(turned);
  return length > 0 ? norm(v) / length * turned : Vector{};
}

/// The factor that brings a vector of this length down to the limit.
double cap(double length, double limit) {
  return length > limit ? limit / length : 1;
}

}  // namespace

Contact::Contact(const Law& law) {
  set_elastic(law, law.youngs_modulus_pa, law.poissons_ratio, law.restitution);
  set_friction(law.friction);
  rolling_friction_ = law.rolling_friction;
  set_plastic(law, 1);
  set_attraction(law, 1, 2);
}

Contact::Contact(const Law& law, const WallLaw& wall) {
  set_elastic(law, wall.youngs_modulus_pa, wall.poissons_ratio, wall.restitution);
  set_friction(wall.friction);
  rolling_friction_ = wall.rolling_friction;
  set_plastic(law, wall.cohesion_factor);
  set_attraction(law, wall.cohesion_factor, 1);
}

void Contact::set_elastic(const Law& law, double e, double nu, double restitution) {
  const double own_nu = law.poissons_ratio, own_e = law.youngs_modulus_pa;
  const double e_star = 1 / ((1 - own_nu * own_nu) / own_e + (1 - nu * nu) / e);
  const double g_star = 1 / ((2 - own_nu) / shear_modulus(own_e, own_nu) + (2 - nu) / shear_modulus(e, nu));
  hertz_ = 4.0 / 3.0 * e_star;
  normal_stiffness_ = 2 * e_star;
  tangential_ratio_ = 4 * g_star / e_star;
  damping_ = 2 * std::sqrt(5.0 / 6.0) * damping_ratio(restitution);
  friction_of_total_ = law.friction_basis != "elastic";
  friction_reserve_ = law.friction_basis == "net" ? 0 : 1;
  if (law.rolling == "spring_dashpot") rolling_ = Rolling::spring_dashpot;
  if (law.rolling == "constant_torque") rolling_ = Rolling::constant_torque;
}

void Contact::set_friction(double friction) {
  friction_ = friction;
  // With the spring's own normal force, the share x of the repulsion, in two rounds as in `act`.
  const double x = std::min(friction * friction / (6 * tangential_ratio_), 0.25);
  slip_limit_ = friction * (1 + x * (1 + x) * (1 + x));
}

void Contact::set_plastic(const Law& law, double share) {
  if (law.normal == "epa") normal_ = Normal::epa;
  if (law.normal == "luding") normal_ = Normal::luding;
  if (!yields()) return;
  adhesion_ = share * law.adhesion_ratio;
  stiffening_ = 1 / (1 - law.plasticity_ratio);
  least_plastic_ = law.plasticity_ratio;
  most_plastic_ = 1 + adhesion_ * (1 - law.plasticity_ratio);
}

void Contact::set_attraction(const Law& law, double share, double shells) {
  cohesion_ = share * law.cohesion_n;
  // A wall counts as flat: its effective radius is the grain's own, twice that of two equal grains.
  size_per_radius_ = shells / law.reference_radius_m;
  if (law.bridge == "none" || share == 0) return;
  c_ = share * law.c_n;
  rupture_gap_ = -law.d_c_m;
  formation_gap_ = law.formation == "film" ? shells * law.offset_m : 0;
  if (law.bridge == "polynomial") {
    bridge_ = Bridge::polynomial;
    a_ = share * law.a_n_m2;
    b_ = share * law.b_n_m;
  } else if (law.bridge == "linear") {
    bridge_ = Bridge::polynomial;
    b_ = c_ / rupture_gap_;
  } else if (law.bridge == "exponential") {
    bridge_ = Bridge::exponential;
    b_ = 3 / rupture_gap_;
  } else {
    bridge_ = Bridge::capillary;
    const double radius = law.reference_radius_m, volume = law.liquid_volume_m3, root = std::cbrt(volume);
    c_ = share * 2 * kPi * radius * law.surface_tension_n_m * std::cos(law.contact_angle_rad);
    rupture_gap_ = (1 + 0.5 * law.contact_angle_rad) * (root + 0.1 * root * root / radius);
    a_ = 2.5 * radius / volume;
    b_ = 1.05 * std::sqrt(radius / volume);
  }
  viscosity_ = 6 * kPi * share * law.viscosity_pa_s;
  roughness_ = kRoughness * law.reference_radius_m;
  touch_excess_ = c_ - cohesion_;
  passage_ = kPassage * law.reference_radius_m;
}

/// Forms and ruptures the bridge; its pull [N], none while the bodies overlap.
double Contact::attraction(double overlap, double scale, ContactHistory& history) const {
  if (bridge_ == Bridge::none) return 0;
  const double gap = -overlap / scale;
  if (gap <= formation_gap_) history.bridge = 1;
  if (gap > rupture_gap_) history.bridge = 0;
  if (history.bridge == 0 || overlap > 0) return 0;
  switch (bridge_) {
    case Bridge::polynomial:
      return scale * scale * ((a_ * gap - b_) * gap + c_);
    case Bridge::exponential:
      return scale * scale * c_ * std::exp(-b_ * gap);
    default:
      return scale * scale * c_ / (1 + (b_ + a_ * gap) * gap);
  }
}

/// Hertz; or, with k1 = 4/3 E* R*^(2-m), m 3/2 or 1, one spring k2 (d^m - p^m) whose plastic overlap p yields where
/// loading, k1 d^m, or the adhesion branch, -kc d^m, begins.
Contact::Press Contact::press(const ContactKinematics& m, double scale, ContactHistory& history) const {
  const bool linear = normal_ == Normal::luding;
  const double contact_radius = linear ? 2.0 / 3 * m.radius : std::sqrt(m.radius * m.overlap);
  const auto power = [linear](double d) { return linear ? d : d * std::sqrt(d); };
  const double loading = hertz_ * (linear ? m.radius : std::sqrt(m.radius)) * power(m.overlap);
  if (!yields()) return {contact_radius, loading, loading, 0};
  const double deep = power(m.overlap);
  const double plastic = std::min(std::max(power(history.bridge), least_plastic_ * deep), most_plastic_ * deep);
  history.bridge = linear ? plastic : std::cbrt(plastic * plastic);
  const double force = stiffening_ * (1 - plastic / deep) * loading, most = adhesion_ * loading;
  return {contact_radius, force, std::max(force + most, 0.0), scale * scale * cohesion_ + most};
}

/// Of bodies that overlap: the cohesion, and what is left of the bridge's force at touch beyond it [N].
double Contact::cohesion(double overlap, double scale) const {
  const double left = std::max(1 - overlap / (passage_ * scale), 0.0);
  return scale * scale * (cohesion_ + left * touch_excess_);
}

ContactForce Contact::act(const ContactKinematics& m, ContactHistory& history, double dt, double advance) const {
  const double scale = size_scale(m.radius);
  const double pull = attraction(m.overlap, scale, history);
  ContactForce contact_force;
  if (m.overlap <= 0) {
    history.slip = history.roll = {};
    history.contact_radius = 0;
    if (yields()) history.bridge = 0;
    contact_force.force = pull * m.normal;
    lubricate(m, scale, dt, history, contact_force);
    return contact_force;
  }
  const Press pressing = press(m, scale, history);
  const double contact_radius = pressing.contact_radius;
  const double stiffness_n = normal_stiffness_ * contact_radius, stiffness_t = tangential_ratio_ * stiffness_n;
  // Velocities are those of half a step ago; the denominators give a collision its restitution to second order in dt.
  const double damping_n = damping_ * std::sqrt(stiffness_n * m.mass);
  const double damping_t = damping_ * std::sqrt(stiffness_t * m.mass);
  const double braked_n = 1 / (1 + 0.25 * dt * damping_n / m.mass);
  const double braked_t = 1 / (1 + 0.25 * 3.5 * dt * damping_t / m.mass);
  const double approach = dot(m.velocity, m.normal);
  double normal_force = pressing.force + braked_n * damping_n * approach - cohesion(m.overlap, scale) - pull;
  const double pressed =
      friction_of_total_ ? std::max(normal_force + friction_reserve_ * pressing.reserve, 0.0) : pressing.load;

  // The spring holds what friction allows of the load. Where it stiffens with the overlap its energy grows with that:
  // it pushes, too.
  const Vector sliding = m.velocity - approach * m.normal;
  Vector slip = carried(history.slip, m.normal, m.twist * advance) + advance * sliding;
  slip = cap(stiffness_t * norm(slip), slip_limit_ * pressing.load) * slip;
  const double widening = normal_ == Normal::luding ? 0 : 0.25 / m.overlap;
  const double slip_normal_force = widening * stiffness_t * dot(slip, slip);
  const Vector drag = stiffness_t * slip + damping_t * braked_t * sliding;
  // Its normal force is part of the load that limits friction: two rounds.
  double kept = cap(norm(drag), friction_ * pressed);
  for (int round = 0; round < 2; ++round)
    kept = cap(norm(drag), friction_ * (pressed + kept * kept * slip_normal_force));
  history.slip = kept * slip;
  contact_force.tangential_force = -kept * drag;
  normal_force += kept * kept * slip_normal_force;
  contact_force.force = contact_force.tangential_force - normal_force * m.normal;
  roll(m, pressed + kept * kept * slip_normal_force, contact_radius, braked_n, dt, advance, history, contact_force);
  history.contact_radius = contact_radius;
  lubricate(m, scale, dt, history, contact_force);
  return contact_force;
}

/// Two bodies lose at most their whole relative velocity in a step.
void Contact::lubricate(const ContactKinematics& m, double scale, double dt, const ContactHistory& history,
                        ContactForce& contact_force) const {
  if (viscosity_ == 0 || history.bridge == 0) return;
  const double narrowness = m.radius / std::max(-m.overlap, roughness_ * scale);
  const double along = viscosity_ * m.radius * narrowness;
  const double across = viscosity_ * m.radius * (8.0 / 15 * std::log(narrowness) + 0.9588);
  const double approach = dot(m.velocity, m.normal);
  const Vector drag = -across / std::max(3.5 * dt * across / m.mass, 1.0) * (m.velocity - approach * m.normal);
  contact_force.tangential_force = contact_force.tangential_force + drag;
  contact_force.force = contact_force.force + drag - along / std::max(dt * along / m.mass, 1.0) * approach * m.normal;
}

void Contact::roll(const ContactKinematics& m, double load, double contact_radius, double braked, double dt,
                   double advance, ContactHistory& history, ContactForce& contact_force) const {
  const double limit = rolling_friction_ * load * m.radius;
  const Vector rolling = m.spin - dot(m.spin, m.normal) * m.normal;
  if (rolling_ == Rolling::spring_dashpot) {
    // Ai et al. 2011: k_r = 2.25 S_n (mu_r R*)^2, dashpot 2 eta sqrt(I_r k_r) with eta 0.3 while the spring holds.
    const double lever = rolling_friction_ * m.radius;
    const double softened = std::min(1.0, history.contact_radius / contact_radius);
    const double stiffness_n = normal_stiffness_ * contact_radius;
    const double stiffness = 2.25 * stiffness_n * lever * lever;
    const Vector turn = softened * carried(history.roll, m.normal, m.twist * advance) + advance * rolling;
    const double kept = cap(stiffness * norm(turn), limit);
    const double dashpot = kept < 1 ? 0
                                    : 0.6 * std::sqrt(1.4 * 2.25) * rolling_friction_ *
                                          std::sqrt(stiffness_n * m.mass) * m.radius * m.radius * braked;
    history.roll = kept * turn;
    contact_force.moment = -stiffness * history.roll - dashpot * rolling;
  } else if (rolling_ == Rolling::constant_torque) {
    // Near rest a dashpot that takes a tenth of a grain's spin in a step; the torque's sign would alternate.
    const double gentle = 0.08 * m.smaller_radius * m.smaller_radius * m.mass / dt;
    const double speed = norm(rolling);
    contact_force.moment = -(speed * gentle > limit ? limit / speed : gentle) * rolling;
  }
}

}  // namespace pastefit_lammps
