#include "calibrate/verify/formulas.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <iterator>
#include <vector>

#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"

namespace pastefit {

Approach pair_of(const Impact& scene) {
  return scene.grains.size() > 1 ? approach_of_grains(scene, 0, 1) : approach_of_wall(scene, 0, 0);
}

double share_of(const Impact& scene) {
  return scene.grains.size() > 1 ? 1 : scene.walls[0].surface.cohesion_factor;
}

double speed_after(const Approach& pair, double work) {
  return std::sqrt(std::max(pair.speed * pair.speed - 2 * work / pair.mass, 0.0));
}

double integral(const std::function<double(double)>& slope, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(slope, from, to);
}

Fault outside(std::string what) {
  return {"expected.formula", std::move(what), "another scene, or another formula"};
}

namespace {

using Arguments = FormulaArguments;

// Normal collisions

double largest_overlap(const Approach& a) {
  return std::pow(15 * a.mass * a.speed * a.speed / (16 * a.modulus * std::sqrt(a.radius)), 0.4);
}

Result<double> hertz_max_force(const Impact& scene, const Arguments&) {
  const Approach a = pair_of(scene);
  return 4.0 / 3.0 * a.modulus * std::sqrt(a.radius) * std::pow(largest_overlap(a), 1.5);
}

Result<double> hertz_duration(const Impact& scene, const Arguments&) {
  const Approach a = pair_of(scene);
  return hertz_contact_time(a, a.speed);
}

// Oblique collisions

/// Impulse on the first grain. If the contact slides throughout, Coulomb's law gives the tangential part mu (1 + e) m*
/// v_n, which must be less than (2/7) m* v_s, the impulse that stops sliding.
Result<Vec3> impulse(const Impact& scene) {
  const Approach a = pair_of(scene);
  if (a.speed <= 0) return outside("the first grain does not approach its partner");
  const double normal = (1 + a.restitution) * a.mass * a.speed;
  const Vec3 tangential = a.velocity - a.speed * a.normal;
  const double sliding = norm(tangential);
  if (a.friction == 0 || sliding < 1e-12 * a.speed) return -normal * a.normal;
  const double friction = a.friction * normal;
  if (3.5 * friction > a.mass * sliding) return outside("the contact does not slide through the whole collision");
  return -normal * a.normal - (friction / sliding) * tangential;
}

Result<double> collision_velocity(const Impact& scene, const Arguments& arguments) {
  const auto on_first = impulse(scene);
  if (!on_first) return on_first.faults();
  const ImpactGrain& grain = scene.grains[arguments.grain];
  const double sign = arguments.grain == 0 ? 1 : -1;
  return (grain.velocity_m_s + (sign / mass_kg(scene, grain)) * on_first.value()).*arguments.axis;
}

Result<double> collision_spin(const Impact& scene, const Arguments& arguments) {
  const auto on_first = impulse(scene);
  if (!on_first) return on_first.faults();
  const ImpactGrain& grain = scene.grains[arguments.grain];
  // Lever and impulse both change sign for the second grain.
  const Vec3 twist = cross(pair_of(scene).normal, on_first.value());
  return (grain.spin_rad_s + (2.5 / (mass_kg(scene, grain) * grain.radius_m)) * twist).*arguments.axis;
}

// Cohesion and bridges

double size_scale(const Impact& scene) {
  return (scene.grains.size() > 1 ? 2 : 1) * pair_of(scene).radius / scene.reference_radius_m;
}

PairConstants constants(const Impact& scene) {
  return scene.grains.size() > 1 ? grain_pair(scene.contact, scene.reference_radius_m)
                                 : wall_pair(scene.contact, scene.walls[0].surface, scene.reference_radius_m);
}

Result<double> cohesive_overlap(const Impact& scene, const Arguments&) {
  const Approach a = pair_of(scene);
  const double s = size_scale(scene);
  return std::pow(0.75 * constants(scene).cohesion * s * s / (a.modulus * std::sqrt(a.radius)), 2.0 / 3.0);
}

/// Force of a bridge at a gap, by its definition.
double attraction(const Impact& scene, double gap) {
  const Bridge& bridge = scene.contact.bridge;
  const double s = size_scale(scene);
  if (gap / s > rupture_gap(bridge, scene.reference_radius_m)) return 0;
  return share_of(scene) * s * s * closed_bridge_n(bridge, scene.reference_radius_m, -gap / s);
}

/// Work of the attraction between two gaps.
double work(const Impact& scene, double from, double to) {
  return integral([&](double gap) { return attraction(scene, gap); }, from, to);
}

double living_gap(const Impact& scene) {
  return rupture_gap(scene.contact.bridge, scene.reference_radius_m) * size_scale(scene);
}

double forming_gap(const Impact& scene) {
  return std::min(constants(scene).formation_gap * size_scale(scene), living_gap(scene));
}

// Sliding and rolling on a wall, along x

struct Slope {
  double sine, cosine;
};

Slope slope_of(const Impact& scene) {
  const Vec3 normal = approach_of_wall(scene, 0, 0).normal;
  return {norm(cross(normal, {0, 0, 1})), -normal.z};
}

Result<double> speed_after_slip(const Impact& scene, const Arguments&) {
  const double wall = scene.walls[0].velocity_m_s.x;
  const ImpactGrain& grain = scene.grains[0];
  const double own = grain.velocity_m_s.x - wall, turning = grain.radius_m * grain.spin_rad_s.y;
  const double slipping = std::fabs(own - turning);
  const double longest = slipping / (3.5 * scene.walls[0].surface.friction * scene.gravity_m_s2);
  if (!(longest < scene.duration_s)) return outside("the grain still slips when the test is over");
  return wall + (5 * own + 2 * turning) / 7;
}

Result<double> slope_speed(const Impact& scene, const Arguments&) {
  const Slope slope = slope_of(scene);
  const WallContact& wall = scene.walls[0].surface;
  const double drive = slope.sine - wall.rolling_friction * slope.cosine;
  if (norm(scene.grains[0].velocity_m_s) == 0 && drive < 0) return 0.0;
  // Friction provides the part of the drive that rotates the grain.
  const double needed = slope.sine - 5.0 / 7.0 * drive;
  if (std::fabs(needed) > wall.friction * slope.cosine) return outside("the grain does not roll, it slips");
  const double speed = norm(scene.grains[0].velocity_m_s) + 5.0 / 7.0 * scene.gravity_m_s2 * drive * scene.duration_s;
  return std::max(speed, 0.0);
}

Result<double> sliding_speed(const Impact& scene, const Arguments&) {
  const Slope slope = slope_of(scene);
  const double drive = slope.sine - scene.walls[0].surface.friction * slope.cosine;
  return norm(scene.grains[0].velocity_m_s) + scene.gravity_m_s2 * drive * scene.duration_s;
}

/// Spin of a grain about y on a frictionless wall, slowed by the rolling torque only.
Result<double> spin_after_decay(const Impact& scene, const Arguments&) {
  const ImpactGrain& grain = scene.grains[0];
  if (scene.walls[0].surface.friction > 0) return outside("friction turns the spin into a run");
  const double lost =
      2.5 * scene.walls[0].surface.rolling_friction * scene.gravity_m_s2 * scene.duration_s / grain.radius_m;
  return std::max(grain.spin_rad_s.y - lost, 0.0);
}

// The free rotor

double start_angle(const ImpactWall& wall) {
  const Vec3 arm = std::get<Plate>(wall.shape).centre - wall.hinge_m;
  return std::atan2(arm.z, arm.x);
}

/// 1/2 I w^2 = moment (sin(start) - sin(angle)), with the moment of the weight in the level position. A load, the first
/// grain, adds m x^2 and m g x; x: its distance from the hinge along the plate.
double rotor_speed_at(const Impact& scene, double angle, bool loaded) {
  const ImpactWall& wall = scene.walls[0];
  const Plate& plate = std::get<Plate>(wall.shape);
  double moment = *wall.rotor_mass_kg * norm(plate.centre - wall.hinge_m), inertia = rotor_inertia(wall);
  if (loaded) {
    const double mass = mass_kg(scene, scene.grains[0]);
    const double x = dot(scene.grains[0].centre_m - wall.hinge_m, plate.along);
    moment += mass * x;
    inertia += mass * x * x;
  }
  const double fallen = std::sin(start_angle(wall)) - std::sin(angle);
  return std::sqrt(2 * moment * scene.gravity_m_s2 * fallen / inertia);
}

/// Integral of d(angle)/w; angle = start (1 - u^2) removes the singularity.
double rotor_time_to_level(const Impact& scene, bool loaded) {
  const double start = start_angle(scene.walls[0]);
  const auto slope = [&](double u) { return 2 * start * u / rotor_speed_at(scene, start * (1 - u * u), loaded); };
  return integral(slope, 0, 1);
}

// A grain among held neighbours

/// Decay rate l of the oscillation along the velocity, x'' + 2 l x' + w^2 x = 0, with springs and dampers of all
/// contacts at their initial overlap, without sliding. A loaded contact also rotates when the grain moves across it:
/// -N/distance.
Result<double> caged_decay_rate(const Impact& scene, const Arguments&) {
  const ImpactGrain& grain = scene.grains[0];
  const double speed = norm(grain.velocity_m_s);
  if (speed == 0) return outside("the first grain does not move");
  const PairConstants pair = constants(scene);
  const Vec3 along = (1 / speed) * grain.velocity_m_s;
  double spring = 0, damper = 0;
  for (std::size_t j = 1; j < scene.grains.size(); ++j) {
    const Approach a = approach_of_grains(scene, 0, j);
    const double distance = norm(scene.grains[j].centre_m - grain.centre_m);
    const double overlap = grain.radius_m + scene.grains[j].radius_m - distance;
    if (!scene.grains[j].held || overlap <= 0) return outside("a neighbour is not held, or does not press");
    const double stiffness = pair.normal_stiffness * std::sqrt(a.radius * overlap);
    const double root = std::sqrt(stiffness * a.mass), ahead = dot(a.normal, along) * dot(a.normal, along);
    spring += stiffness * (ahead + (1 - ahead) * (pair.tangential_ratio - 2.0 / 3.0 * overlap / distance));
    damper += root * (ahead * pair.damping + (1 - ahead) * pair.tangential_damping);
  }
  const double mass = mass_kg(scene, grain), loss = 0.5 * damper / mass, square = spring / mass - loss * loss;
  if (!(square > 0)) return outside("the dampers are too strong for the grain to swing");
  return loss;
}

constexpr Formula kFormulas[] = {
    {"hertz_max_overlap", [](auto& scene, auto&) -> Result<double> { return largest_overlap(pair_of(scene)); },
     "(15 m* v^2/(16 E* sqrt(R*)))^(2/5)"},
    {"hertz_max_force", hertz_max_force, "4/3 E* sqrt(R*) d^(3/2) at the largest overlap"},
    {"hertz_contact_time", hertz_duration, "2.868 (m*^2/(R* E*^2 v))^(1/5)"},
    {"collision_velocity", collision_velocity,
     "after a collision with impulse (1+e) m* v_n and gross sliding mu (1+e) m* v_n"},
    {"collision_spin", collision_spin, "w + 5/(2 m R) n x impulse, gross sliding"},
    {"initial_velocity",
     [](auto& scene, auto& arguments) -> Result<double> {
       return scene.grains[arguments.grain].velocity_m_s.*arguments.axis;
     },
     "as at the start", FormulaNeeds::grain},
    {"initial_spin",
     [](auto& scene, auto& arguments) -> Result<double> {
       return scene.grains[arguments.grain].spin_rad_s.*arguments.axis;
     },
     "as at the start", FormulaNeeds::grain},
    {"cohesive_overlap", cohesive_overlap, "at rest: (3 F_coh/(4 E* sqrt(R*)))^(2/3)"},
    {"bridge_force", [](auto& scene, auto& arguments) -> Result<double> { return attraction(scene, arguments.gap_m); },
     "F(d) at a gap, zero beyond the rupture"},
    {"bridge_work", [](auto& scene, auto&) -> Result<double> { return work(scene, 0, living_gap(scene)); },
     "integral of F from touch to rupture"},
    {"bridge_loop_area",
     [](auto& scene, auto&) -> Result<double> { return work(scene, forming_gap(scene), living_gap(scene)); },
     "integral of F from the formation gap to rupture"},
    {"speed_after_rupture",
     [](auto& scene, auto&) -> Result<double> {
       return speed_after(pair_of(scene), work(scene, 0, living_gap(scene)));
     },
     "sqrt(v^2 - 2 W/m*), from touch"},
    {"speed_after_rebound",
     [](auto& scene, auto&) -> Result<double> {
       return speed_after(pair_of(scene), work(scene, forming_gap(scene), living_gap(scene)));
     },
     "sqrt(v^2 - 2 W/m*), W from the formation gap to rupture"},
    {"speed_after_slip", speed_after_slip, "5/7 v + 2/7 r w relative to the wall, once the grain rolls",
     FormulaNeeds::wall},
    {"slope_speed", slope_speed, "v + 5/7 g (sin - mu_r cos) t, rolling; 0 if mu_r >= tan", FormulaNeeds::wall},
    {"sliding_speed", sliding_speed, "v + g (sin - mu cos) t", FormulaNeeds::wall},
    {"spin_after_decay", spin_after_decay, "w - 5 mu_r g t/(2 r)", FormulaNeeds::wall},
    {"rotor_speed", [](auto& scene, auto&) -> Result<double> { return rotor_speed_at(scene, 0, false); },
     "sqrt(3 g sin(angle)/L) for a plate hinged at its edge", FormulaNeeds::rotor},
    {"rotor_time", [](auto& scene, auto&) -> Result<double> { return rotor_time_to_level(scene, false); },
     "integral of d(angle)/w", FormulaNeeds::rotor},
    {"loaded_rotor_speed", [](auto& scene, auto&) -> Result<double> { return rotor_speed_at(scene, 0, true); },
     "the same with the first grain on the plate, its contact stiff", FormulaNeeds::rotor},
    {"loaded_rotor_time", [](auto& scene, auto&) -> Result<double> { return rotor_time_to_level(scene, true); },
     "the same with the first grain on the plate, its contact stiff", FormulaNeeds::rotor},
    {"caged_decay_rate", caged_decay_rate, "sum of the neighbours' dampers at their first overlap along v, over 2 m"},
    {"falling_velocity",
     [](auto& scene, auto&) -> Result<double> {
       return scene.grains[0].velocity_m_s.z - scene.gravity_m_s2 * scene.duration_s;
     },
     "v - g t", FormulaNeeds::grain},
};

std::string_view what_lacks(FormulaNeeds needs, const Impact& scene) {
  if (needs == FormulaNeeds::pair && scene.grains.size() < 2 && scene.walls.empty())
    return "the first grain has no partner, neither a second grain nor a wall";
  if (needs == FormulaNeeds::wall && scene.walls.empty()) return "there is no wall";
  const auto is_rotor = [](const ImpactWall& wall) {
    return std::holds_alternative<Plate>(wall.shape) && wall.rotor_mass_kg;
  };
  if (needs == FormulaNeeds::rotor && (scene.walls.empty() || !is_rotor(scene.walls[0])))
    return "the first wall is not a plate with a rotor_mass_kg";
  return {};
}

}  // namespace

Result<double> value_of(const Formula& formula, const Impact& scene, const FormulaArguments& arguments) {
  if (const auto lack = what_lacks(formula.needs, scene); !lack.empty()) return outside(std::string(lack));
  if (arguments.grain >= scene.grains.size()) return outside("there is no grain " + std::to_string(arguments.grain));
  return formula.value(scene, arguments);
}

std::span<const Formula> formulas() {
  static const std::vector<Formula> all = [] {
    std::vector<Formula> rows(std::begin(kFormulas), std::end(kFormulas));
    for (const auto more : {sticking_formulas(), viscous_formulas()}) rows.insert(rows.end(), more.begin(), more.end());
    return rows;
  }();
  return all;
}

}  // namespace pastefit
