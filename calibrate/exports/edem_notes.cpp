#include <numbers>
#include <optional>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/verify/force_curve.h"

namespace pastefit {

namespace {

std::string rolling_in_edem(const ContactModel& contact) {
  if (contact.rolling == RollingModel::none || contact.rolling_friction == 0) return "2. Rolling friction: none.\n";
  return format("2. Rolling friction: %.6g, with EDEM's rolling model ", contact.rolling_friction) +
         (contact.rolling == RollingModel::spring_dashpot ? "\"Type C\" (a spring and a dashpot"
                                                          : "\"RVD\" (a constant torque against the relative spin") +
         ",\n   lever R* = r1 r2/(r1 + r2)). Not \"Standard Rolling Friction\": it takes the distance to the centre "
         "and\n"
         "   each body's own spin, and is twice as strong between equal grains.\n";
}

/// `surface_energy`: of two grains.
std::string walls_in_edem(const ExportScene& scene, double surface_energy) {
  std::string out;
  for (const auto& [name, wall] : scene.walls())
    out += format(
        "   %s: shear modulus %.6g MPa, Poisson's ratio %.6g, restitution %.6g, static friction %.6g,\n"
        "   rolling friction %.6g, surface energy %.6g J/m2\n",
        name, 1e-6 * shear_modulus_pa(wall), wall.poissons_ratio, wall.restitution, wall.friction,
        wall.rolling_friction, wall.cohesion_factor * surface_energy);
  return out;
}

/// Script for EDEMpy. `surface_energy`: of two grains with EDEM's JKR; none with another contact model, which is typed
/// by hand, as `rest` says.
ExportFile edem_script(const ExportScene& scene, std::optional<double> surface_energy, const std::string& rest) {
  constexpr double steel_kg_m3 = 7800;  // of walls, which no grain moves
  const ContactModel& contact = scene.contact();
  const auto material = [](const std::string& name, double poissons_ratio, double shear_pa, double density,
                           const char* bulk) {
    return format("    (\"%s\", %.9g, %.9g, %.9g, %s),\n", name, poissons_ratio, shear_pa, density, bulk);
  };
  const auto interaction = [](const std::string& with, double restitution, double friction, double rolling) {
    return format("    (\"grains\", \"%s\", %.9g, %.9g, %.9g),\n", with, restitution, friction, rolling);
  };
  std::string materials = material("grains", contact.poissons_ratio, shear_modulus_pa(contact),
                                   scene.card_density_kg_m3.value_or(scene.grain_density_kg_m3), "True");
  std::string interactions = interaction("grains", contact.restitution, contact.friction,
                                         contact.rolling == RollingModel::none ? 0 : contact.rolling_friction);
  for (const auto& [name, wall] : scene.walls()) {
    materials += material(name, wall.poissons_ratio, shear_modulus_pa(wall), steel_kg_m3, "False");
    interactions += interaction(name, wall.restitution, wall.friction, wall.rolling_friction);
  }
  return {"edem_material.py", filled_in("exports/texts/edem_material.py",
                                        {{"rest", rest},
                                         {"materials", materials},
                                         {"interactions", interactions},
                                         {"energy", surface_energy ? format("%.9g", *surface_energy) : "None"}})};
}

/// `more`: what the model needs beside the numbers of grains. `energy`: surface energy of two grains.
std::string edem_instructions(const ExportScene& scene, const std::string& model, const std::string& more,
                              double energy, const std::string& rest = "") {
  const ContactModel& contact = scene.contact();
  return filled_in(
      "exports/texts/edem.txt",
      {{"laws", laws_in_words(scene)},
       {"model", model},
       {"grains",
        format("shear modulus %.6g MPa, Poisson's ratio %.6g, restitution %.6g,\n   static friction %.6g",
               1e-6 * shear_modulus_pa(contact), contact.poissons_ratio, contact.restitution, contact.friction)},
       {"more", more},
       {"rolling", rolling_in_edem(contact)},
       {"walls", walls_in_edem(scene, energy)},
       {"rest", rest}});
}

/// EEPA parameters of two grains, or of a wall with a share of their attraction. A pull-off is added to the force.
std::string eepa_numbers(const ContactModel& contact, double energy, double pull_off, double share) {
  return format(
      "constant pull-off force %.6g N of attraction, surface energy %.6g J/m2, contact plasticity ratio %.6g,\n"
      "   slope exponent 1.5, tensile exponent 1.5, tangential stiffness multiplier 1",
      share * pull_off, share * energy, contact.plasticity_ratio);
}

Export eepa_notes(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double overlap = matched_overlap_ratio(scene) * 0.5 * scene.radius_m();
  const double energy = eepa_surface_energy(scene), pull_off = cohesion_n(contact, scene.mean_pair());
  std::string wall_numbers;
  for (const auto& [name, wall] : scene.walls())
    wall_numbers += "   " + name + ": " + eepa_numbers(contact, energy, pull_off, wall.cohesion_factor) + ".\n";
  const std::string instructions = edem_instructions(
      scene, "Edinburgh Elasto-Plastic Adhesion (EEPA)", ";\n   " + eepa_numbers(contact, energy, pull_off, 1) + ".",
      energy, filled_in("exports/texts/edem_eepa.txt", {{"wall_numbers", wall_numbers}}));
  return {law_files(scene, {{"edem.txt", instructions},
                            edem_script(scene, {}, "the contact model EEPA, the rolling model and the radii")}),
          {"Exponents, modulus, plasticity ratio and constant pull-off force are the card's.",
           format("The adhesion ratio has no counterpart in the dialogue. EDEM's EEPA takes the pull-off of a contact "
                  "from a surface energy, 1.5 pi gamma a with a the radius of the patch that was flattened, and lays "
                  "the adhesion branch through it; the card's pull-off is a share of the load that pressed the "
                  "contact. The energy given is such that both are the same for two mean grains once pressed %.3g mm "
                  "into each other. A contact that was pressed half as deep holds twice the card's pull-off in EDEM, "
                  "but at most half of k2 p^m; a deeper one less.",
                  1e3 * overlap),
           "Not run in EDEM. PFC's eepa and LIGGGHTS's edinburgh without fixKc have the same pull-off."}};
}

std::string bridge_instructions(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double touch = attraction_n(contact, scene.mean_pair(), 0);
  // Surface energy of JKR with this attraction of two mean grains at touch, 8/3 pi gamma R*, R* = R/2.
  const double energy = 3 * touch / (4 * std::numbers::pi * scene.radius_m());
  std::string attraction;
  if (touch > 0)
    attraction = filled_in("exports/texts/edem_attraction.txt",
                           {{"half_gap", shown(500 * bridge_gaps(contact, scene.mean_pair()).rupture_m)},
                            {"energy", shown(energy)},
                            {"touch", shown(touch)}});
  return edem_instructions(scene, "Hertz-Mindlin (no slip)",
                           ".\n   EDEM's damping is the same function of the restitution.", energy, attraction);
}

}  // namespace

Result<Export> export_edem_notes(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const bool sticks = contact.normal == NormalLaw::jkr;
  KnownLaws known{"EDEM", {NormalLaw::hertz, NormalLaw::jkr, NormalLaw::epa}, kAllRolling};
  if (sticks) known.attraction = {BridgeShape::none};  // a plug-in replaces EDEM's JKR
  if (Faults faults = unknown_laws(contact, known); !faults.empty()) return faults;
  if (contact.normal == NormalLaw::epa) return eepa_notes(scene);
  if (sticks) {
    const double energy = contact.surface_energy_j_m2;
    const std::string more =
        format(", surface energy %.6g J/m2.\n   EDEM's JKR is this law; its grains separate at a distance that is ",
               energy) +
        "a third of a percent smaller.";
    return Export{law_files(scene, {{"edem.txt", edem_instructions(scene, "Hertz-Mindlin with JKR", more, energy)},
                                    edem_script(scene, energy,
                                                "the surface energies of walls, the rolling model and the radii")}),
                  {"EDEM's JKR lets go of grains at 0.917 of the contact radius at which pastefit's does, a third of a "
                   "percent sooner in distance.",
                   "Not run in EDEM."}};
  }
  Export out{
      law_files(scene, {{"edem.txt", bridge_instructions(scene)},
                        edem_script(scene, {}, "the attraction, the rolling model and the radii")}),
      {"EDEM has no bridge across a gap without a plug-in; its JKR attracts only after contact.", "Not run in EDEM."}};
  if (contact.bridge.shape != BridgeShape::none)
    out.own_law = R"("contact": {"normal": "jkr", "attraction": "none"}, with "adhesion_pa" free)";
  return out;
}

}  // namespace pastefit
