#include "calibrate/study/impact_json.h"

#include <numbers>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/names.h"
#include "core/apparatus/impact/approach.h"

namespace pastefit {

namespace {

using nlohmann::json;

constexpr Range kAny{-1e9, 1e9};
constexpr Range kLength{0, 1e3, true};
constexpr Range kModulus{1, 1e30, true};  // the largest value stands for a rigid wall
constexpr Range kRestitution{0, 1, true};
constexpr Range kShare{0, 10};

bool read_vector(ObjectReader& reader, std::string_view key, Vec3& target, Need need) {
  std::vector<double> numbers;
  if (!reader.numbers(key, numbers, kAny, need, 3, 3)) return false;
  target = {numbers[0], numbers[1], numbers[2]};
  return true;
}

void read_direction(ObjectReader& reader, std::string_view key, Vec3& target) {
  Vec3 given = target;
  if (!read_vector(reader, key, given, Need::optional)) return;
  if (const double length = norm(given); length > 0)
    target = (1 / length) * given;
  else
    reader.fault(key, "is not a direction", "a vector that is not zero, e.g. [0, 0, 1]");
}

/// Reads a vector, or a speed with the angle from the downward vertical towards +x.
void read_velocity(ObjectReader& reader, Vec3& target) {
  const json* given = reader.content("velocity_m_s");
  if (!given || !given->is_object()) {
    read_vector(reader, "velocity_m_s", target, Need::optional);
    return;
  }
  reader.object("velocity_m_s", Need::optional, [&](ObjectReader& polar) {
    double speed = 0, angle = 0;
    polar.number("speed", speed, kAny, Need::required);
    polar.number("angle_deg", angle, {-180, 180}, Need::required, 180 / std::numbers::pi);
    target = {speed * std::sin(angle), 0, -speed * std::cos(angle)};
  });
}

void read_bridge(ObjectReader& reader, Bridge& bridge) {
  reader.choice("shape", bridge.shape, bridge_shapes, Need::required);
  reader.choice("formation", bridge.formation, bridge_formations, Need::optional);
  const bool capillary = bridge.shape == BridgeShape::capillary;
  const Need law = capillary ? Need::optional : Need::required;
  const Need polynomial = bridge.shape == BridgeShape::polynomial ? Need::required : Need::optional;
  reader.number("a_n_m2", bridge.a_n_m2, kAny, polynomial);
  reader.number("b_n_m", bridge.b_n_m, kAny, polynomial);
  reader.number("c_n", bridge.c_n, {0, 1e9}, law);
  reader.number("d_c_m", bridge.d_c_m, {-1e3, 0}, law);
  reader.number("offset_m", bridge.offset_m, {0, 1e3}, Need::optional);
  const Need liquid = capillary ? Need::required : Need::optional;
  reader.number("liquid_volume_m3", bridge.liquid_volume_m3, {0, 1e3}, liquid);
  reader.number("surface_tension_n_m", bridge.surface_tension_n_m, {0, 1e4}, liquid);
  reader.number("contact_angle_rad", bridge.contact_angle_rad, {0, std::numbers::pi / 2}, liquid);
  reader.number("viscosity_pa_s", bridge.viscosity_pa_s, {0, 1e9}, Need::optional);
}

void read_impact_contact(ObjectReader& reader, ContactModel& contact) {
  reader.number("youngs_modulus_pa", contact.youngs_modulus_pa, kModulus, Need::required);
  reader.number("poissons_ratio", contact.poissons_ratio, {0, 0.5}, Need::required);
  reader.number("restitution", contact.restitution, kRestitution, Need::optional);
  reader.number("friction", contact.friction, kShare, Need::optional);
  reader.number("rolling_friction", contact.rolling_friction, kShare, Need::optional);
  reader.choice("normal", contact.normal, normal_laws, Need::optional);
  reader.number("surface_energy_j_m2", contact.surface_energy_j_m2, {0, 1e6}, Need::optional);
  reader.number("cohesion_energy_density_pa", contact.cohesion_energy_density_pa, {0, 1e12}, Need::optional);
  reader.number("plasticity_ratio", contact.plasticity_ratio, {0, kMostPlastic}, Need::optional);
  reader.number("adhesion_ratio", contact.adhesion_ratio, {0, kMostAdhesive}, Need::optional);
  reader.choice("rolling", contact.rolling, rolling_models, Need::optional);
  reader.choice("friction_basis", contact.friction_basis, friction_bases, Need::optional);
  reader.nullable_number("cohesion_n", contact.cohesion_n, {0, 1e9}, Need::optional);
  reader.object("bridge", Need::optional, [&](ObjectReader& b) { read_bridge(b, contact.bridge); });
}

void read_grain(ObjectReader& reader, ImpactGrain& grain) {
  reader.number("radius_m", grain.radius_m, kLength, Need::required);
  read_vector(reader, "centre_m", grain.centre_m, Need::required);
  read_velocity(reader, grain.velocity_m_s);
  read_vector(reader, "spin_rad_s", grain.spin_rad_s, Need::optional);
  reader.flag("held", grain.held, Need::optional);
  reader.nullable_number("turns_at_s", grain.turns_at_s, {0, 1e6}, Need::optional);
}

void read_shape(ObjectReader& reader, ImpactWall& wall) {
  const int shapes = static_cast<int>(reader.has("plane")) + reader.has("plate") + reader.has("shell");
  if (shapes != 1) reader.fault("plane", "one shape is needed", "give \"plane\", \"plate\" or \"shell\", and only one");
  reader.object("plane", Need::optional, [&](ObjectReader& of) {
    Plane plane;
    read_vector(of, "point_m", plane.point, Need::optional);
    read_direction(of, "normal", plane.normal);
    wall.shape = plane;
  });
  reader.object("plate", Need::optional, [&](ObjectReader& of) {
    Plate plate;
    read_vector(of, "centre_m", plate.centre, Need::optional);
    read_direction(of, "along", plate.along);
    read_direction(of, "across", plate.across);
    of.number("length_m", plate.half_length, kLength, Need::required, 2);
    of.number("width_m", plate.half_width, kLength, Need::required, 2);
    if (std::fabs(dot(plate.along, plate.across)) > 1e-9)
      of.fault("across", "is not at a right angle to \"along\"", "two orthogonal directions");
    wall.shape = plate;
  });
  reader.object("shell", Need::optional, [&](ObjectReader& of) {
    Shell shell;
    read_vector(of, "base_m", shell.base, Need::optional);
    of.number("base_radius_m", shell.base_radius, kLength, Need::required);
    of.number("top_radius_m", shell.top_radius, kLength, Need::required);
    of.number("height_m", shell.height, kLength, Need::required);
    wall.shape = shell;
  });
}

void read_wall(ObjectReader& reader, ImpactWall& wall) {
  read_shape(reader, wall);
  wall.surface.friction = wall.surface.rolling_friction = 0;
  wall.surface.restitution = 1;
  reader.number("youngs_modulus_pa", wall.surface.youngs_modulus_pa, kModulus, Need::required);
  reader.number("poissons_ratio", wall.surface.poissons_ratio, {0, 0.5}, Need::optional);
  reader.number("restitution", wall.surface.restitution, kRestitution, Need::optional);
  reader.number("friction", wall.surface.friction, kShare, Need::optional);
  reader.number("rolling_friction", wall.surface.rolling_friction, kShare, Need::optional);
  reader.number("cohesion_factor", wall.surface.cohesion_factor, kShare, Need::optional);
  read_vector(reader, "velocity_m_s", wall.velocity_m_s, Need::optional);
  read_vector(reader, "hinge_m", wall.hinge_m, Need::optional);
  reader.number("turning_rad_s", wall.turning_rad_s, kAny, Need::optional);
  reader.nullable_number("rotor_mass_kg", wall.rotor_mass_kg, {0, 1e9, true}, Need::optional);
}

void read_step(ObjectReader& reader, Impact& test) {
  const json* given = reader.content("time_step");
  if (given && *given == "engine") {
    reader.known("time_step");
    test.step = ImpactStep::engine;
    return;
  }
  if (!given) return reader.known("time_step");
  reader.object("time_step", Need::optional, [&](ObjectReader& step) {
    if (step.number("fixed_s", test.step_s, {0, 1, true}, Need::optional))
      test.step = ImpactStep::fixed;
    else
      step.number("steps_per_contact", test.steps_per_contact, {2, 1e6}, Need::required);
  });
}

void read_duration(ObjectReader& reader, Impact& test) {
  const bool in_contacts = reader.has("duration_contacts");
  double contacts = 0;
  reader.number("duration_contacts", contacts, {0, 1e6, true}, Need::optional);
  reader.number("duration_s", test.duration_s, {0, 1e6, true}, in_contacts ? Need::optional : Need::required);
  if (!in_contacts || contacts == 0) return;
  if (test.grains.size() + test.walls.size() < 2 || test.grains.empty()) return;
  const Approach first = test.grains.size() > 1 ? approach_of_grains(test, 0, 1) : approach_of_wall(test, 0, 0);
  if (first.speed > 0)
    test.duration_s = contacts * hertz_contact_time(first, first.speed);
  else
    reader.fault("duration_contacts", "the first grain does not approach its partner", "give duration_s");
}

}  // namespace

void read_impact(ObjectReader& reader, Impact& test) {
  const std::size_t before = reader.faults().size();
  test.contact = {};
  test.contact.restitution = 1;
  test.contact.friction = test.contact.rolling_friction = 0;
  test.contact.rolling = RollingModel::none;
  reader.object("contact", Need::required, [&](ObjectReader& contact) { read_impact_contact(contact, test.contact); });
  reader.number("density_kg_m3", test.density_kg_m3, {0, 1e12, true}, Need::required);
  reader.list("grains", test.grains, Need::optional, read_grain);
  reader.list("walls", test.walls, Need::optional, read_wall);
  if (!test.grains.empty()) test.reference_radius_m = test.grains[0].radius_m;
  reader.number("reference_radius_m", test.reference_radius_m, kLength, Need::optional);
  reader.number("gravity_m_s2", test.gravity_m_s2, {0, 1e4}, Need::optional);
  reader.numbers("pull_gaps_m", test.pull_gaps_m, {-1e3, 1e3}, Need::optional, 1);
  read_step(reader, test);
  if (reader.faults().size() == before) {
    read_duration(reader, test);
  } else {
    reader.known("duration_s");
    reader.known("duration_contacts");
  }
  if (reader.faults().size() > before) return;
  for (Fault& fault : validate(test)) reader.fault(fault.where, fault.what, fault.remedy);
}

Result<Impact> impact_from_json(const json& document) {
  Impact test;
  const Faults faults = read_document(document, "pastefit-impact-1", [&](ObjectReader& reader) {
    std::string title;
    reader.text("title", title, Need::optional);
    read_impact(reader, test);
  });
  if (!faults.empty()) return faults;
  return test;
}

}  // namespace pastefit
