#include <algorithm>

#include "calibrate/base/text.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/report/summary.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

constexpr double mega = 1e-6, milli = 1e3;

std::string name_for_people(NormalLaw law) {
  switch (law) {
    case NormalLaw::hertz:
      return "Hertz-Mindlin";
    case NormalLaw::jkr:
      return "Hertz-Mindlin with JKR adhesion";
    case NormalLaw::epa:
      return "Edinburgh elasto-plastic adhesion (EEPA)";
    case NormalLaw::luding:
      return "linear elasto-plastic adhesion (Luding)";
    default:
      return "normal law " + word_of(law, normal_laws);
  }
}

/// With the types of Ai et al. (Powder Technology 206 (2011) 269) and the abbreviations of manuals.
std::string name_for_people(RollingModel model) {
  return model == RollingModel::constant_torque ? "constant torque (CDT, type A)" : "spring-dashpot (EPSD, type C)";
}

TypeInGroup grains_to_type(const Material& material) {
  const GrainSizes& grains = material.grains;
  const ContactModel& contact = material.contact;
  TypeInGroup group{"Grains", {{"radius", milli * grains.radius_m, "mm", ""}}};
  if (grains.distribution != SizeDistribution::mono) {
    group.rows.front().remark = "mean; " + word_of(grains.distribution, size_distributions) + " distribution";
    group.rows.push_back({"smallest radius", milli * grains.smallest_m, "mm", ""});
    group.rows.push_back({"largest radius", milli * grains.largest_m, "mm", ""});
    if (grains.distribution == SizeDistribution::normal)
      group.rows.push_back({"deviation of radii", milli * grains.standard_deviation_m, "mm", ""});
  }
  if (material.grain_density_kg_m3)
    group.rows.push_back({"density of a grain", *material.grain_density_kg_m3, "kg/m3",
                          "for a bulk of " + typed(material.bulk_density_kg_m3) + " kg/m3"});
  group.rows.push_back({"Young's modulus", mega * contact.youngs_modulus_pa, "MPa", ""});
  group.rows.push_back({"shear modulus", mega * shear_modulus_pa(contact), "MPa", ""});
  group.rows.push_back({"Poisson's ratio", contact.poissons_ratio, "", ""});
  return group;
}

/// Longest time step of the card's export, for the smallest grains.
double longest_step_s(const Card& card, const Test& test) {
  ExportScene scene;
  scene.test = test;
  const GrainSizes& grains = scene.grains();
  scene.grain_density_kg_m3 = card.material.grain_density_kg_m3.value_or(card.material.bulk_density_kg_m3);
  scene.sizes.radii_m = {grains.distribution == SizeDistribution::mono ? grains.radius_m : grains.smallest_m};
  return deck_time_step_s(scene);
}

TypeInGroup grain_on_grain(const ContactModel& contact, double radius) {
  TypeInGroup group{"Grain on grain: " + name_for_people(contact.normal),
                    {{"restitution", contact.restitution, "", "without attraction"},
                     {"sliding friction", contact.friction, "",
                      "of the " + word_of(contact.friction_basis, friction_bases) + " normal force"}}};
  if (contact.rolling != RollingModel::none)
    group.rows.insert(group.rows.end(),
                      {{"rolling friction", contact.rolling_friction, "", name_for_people(contact.rolling)},
                       {"lever of rolling friction", milli * 0.5 * radius, "mm", "R* of two mean grains"}});
  if (contact.surface_energy_j_m2 > 0)
    group.rows.push_back({"surface energy", contact.surface_energy_j_m2, "J/m2", "half the work of adhesion"});
  if (contact.cohesion_energy_density_pa > 0)
    group.rows.push_back({"cohesion energy density", contact.cohesion_energy_density_pa, "J/m3", "SJKR"});
  if (contact.normal == NormalLaw::epa || contact.normal == NormalLaw::luding) {
    group.rows.push_back({"plasticity ratio", contact.plasticity_ratio, "", "1 - k1/k2"});
    group.rows.push_back({"adhesion ratio", contact.adhesion_ratio, "", "kc/k1"});
    group.rows.push_back({"constant pull-off", contact.cohesion_n.value_or(0), "N", "f0"});
    group.rows.push_back({"exponent", contact.normal == NormalLaw::epa ? 1.5 : 1, "", "of loading and adhesion"});
  }
  return group;
}

TypeInGroup grain_on(const Surface& surface, const ContactModel& contact, bool attracts) {
  const WallContact& wall = surface.contact;
  TypeInGroup group{"Grain on " + std::string(surface.name),
                    {{"restitution", wall.restitution, "", ""}, {"sliding friction", wall.friction, "", ""}}};
  if (contact.rolling != RollingModel::none) group.rows.push_back({"rolling friction", wall.rolling_friction, "", ""});
  if (attracts) group.rows.push_back({"share of the attraction", wall.cohesion_factor, "", "that acts on it"});
  group.rows.push_back({"its Young's modulus", mega * wall.youngs_modulus_pa, "MPa", ""});
  group.rows.push_back({"its Poisson's ratio", wall.poissons_ratio, "", ""});
  return group;
}

TypeInGroup attraction_of(const Material& material) {
  const ContactModel& contact = material.contact;
  const Bridge& bridge = contact.bridge;
  const double radius = material.grains.radius_m, at_touch = attraction_at_touch(bridge, radius);
  const bool polynomial = bridge.shape == BridgeShape::polynomial;
  TypeInGroup group{"Attraction across a gap: " + (polynomial ? "a d^2 + b d + c, overlap d from d_c to 0"
                                                              : word_of(bridge.shape, bridge_shapes)),
                    {}};
  if (polynomial) {
    group.rows.push_back({"a", bridge.a_n_m2, "N/m2", ""});
    group.rows.push_back({"b", bridge.b_n_m, "N/m", ""});
  }
  if (bridge.shape == BridgeShape::capillary) {
    group.rows.push_back({"liquid volume of a bridge", 1e9 * bridge.liquid_volume_m3, "mm3", ""});
    group.rows.push_back({"surface tension", bridge.surface_tension_n_m, "N/m", ""});
    group.rows.push_back({"contact angle", bridge.contact_angle_rad, "rad", ""});
  }
  group.rows.push_back({"formation gap", milli * bridge_gaps(contact, {radius, radius, radius}).formation_m, "mm",
                        "goes with R*, a force with R*^2"});
  group.rows.push_back({"c", at_touch, "N", "attraction at touch"});
  group.rows.push_back({"d_c", -milli * rupture_gap(bridge, radius), "mm", "rupture (negative: a gap)"});
  group.rows.push_back(
      {"offset", milli * bridge.offset_m, "mm",
       bridge.formation == BridgeFormation::film ? "liquid shell of a grain" : "not used: forms at touch"});
  group.rows.push_back({"cohesion", contact.cohesion_n.value_or(at_touch), "N", "constant attraction in overlap"});
  if (bridge.viscosity_pa_s > 0) {
    group.rows.push_back({"viscosity", bridge.viscosity_pa_s, "Pa s", "viscous force of a bridge"});
    group.rows.push_back({"roughness", milli * kRoughness * radius, "mm", "smallest gap in the viscous force"});
  }
  return group;
}

}  // namespace

std::string typed(double value) {
  constexpr int digits = 5;
  return plain(value, digits);
}

std::vector<TypeInGroup> type_in_table(const Card& card) {
  const ContactModel& contact = card.material.contact;
  const bool bridges = contact.bridge.shape != BridgeShape::none;
  const bool attracts = bridges || contact.normal != NormalLaw::hertz;
  std::vector<TypeInGroup> groups{grains_to_type(card.material),
                                  grain_on_grain(contact, card.material.grains.radius_m)};
  double step_s = longest_step_s(card, card.tests.front().test);
  for (const CardTest& one : card.tests) step_s = std::min(step_s, longest_step_s(card, one.test));
  groups.front().rows.push_back({"longest time step", step_s, "s", "at most"});
  if (bridges) groups.push_back(attraction_of(card.material));
  for (const CardTest& one : card.tests) {
    Test test = one.test;
    for (const Surface& surface : surfaces_of(test)) {
      TypeInGroup group = grain_on(surface, contact, attracts);
      const auto same = [&](const TypeInGroup& known) { return known.title == group.title; };
      if (std::ranges::none_of(groups, same)) groups.push_back(std::move(group));
    }
  }
  return groups;
}

std::vector<std::string> damping_law(NormalLaw law) {
  const std::string contact_radius = law == NormalLaw::jkr      ? "a the contact radius"
                                     : law == NormalLaw::luding ? "a = 2/3 R*"
                                                                : "a = sqrt(R* d)";
  return {"force 2 sqrt(5/6) beta sqrt(S m*) times the speed",
          "beta = -ln e/sqrt(ln^2 e + pi^2), e the restitution of the pair",
          "S = 2 E* a normal and 8 G* a tangential, " + contact_radius};
}

std::string type_in_lines(const Card& card) {
  std::string out = "Type this into your DEM program (valid for grains of this size only)\n";
  for (const TypeInGroup& group : type_in_table(card)) {
    out += "  " + group.title + "\n";
    for (const TypeInRow& row : group.rows) {
      const std::string remark = row.remark.empty() ? "" : "  " + row.remark;
      out += format("    %-24s %10s %-6s", row.quantity, typed(row.value), row.unit);
      while (remark.empty() && out.back() == ' ') out.pop_back();
      out += remark + "\n";
    }
  }
  out += "  Damping of each pair:\n";
  for (const std::string& line : damping_law(card.material.contact.normal)) out += "    " + line + "\n";
  return out;
}

}  // namespace pastefit
