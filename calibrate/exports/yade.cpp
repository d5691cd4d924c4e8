#include <numbers>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/store/program.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

/// `contact`: the law as written, possibly a substitute.
std::string module_of(const ExportScene& scene, const ContactModel& contact) {
  const auto& bridge = contact.bridge;
  const double radius = scene.radius_m();
  const GrainPair pair = scene.mean_pair();
  const auto gaps = bridge_gaps(contact, pair);
  const PairConstants constants = grain_pair(contact, radius);
  const bool rolls = contact.rolling != RollingModel::none && contact.rolling_friction > 0;
  const double lever = rolling_spring_lever(contact.rolling, contact.rolling_friction) * pair.effective_radius_m();
  const auto& walls = scene.walls();

  std::string names, materials = "(" + exact(contact.youngs_modulus_pa) + ", " + exact(contact.poissons_ratio) + ", " +
                                 exact(scene.grain_density_kg_m3) + ", " + exact(contact.friction) + "),\n";
  std::string restitution = exact(contact.restitution), friction = exact(contact.friction);
  for (const auto& [name, wall] : walls) {
    names += "'" + name + "', ";
    materials += "             (" + exact(wall.youngs_modulus_pa) + ", " + exact(wall.poissons_ratio) + ", 2500, " +
                 exact(wall.friction) + "),  # " + name + "\n";
    restitution += ", " + exact(wall.restitution);
    friction += ", " + exact(wall.friction);
  }
  return filled_in("exports/texts/yade_material.py",
                   {{"program", program_identity()},
                    {"title", deck_comment(scene.title)},
                    {"shape", word_of(bridge.shape, bridge_shapes)},
                    {"radius", exact(radius)},
                    {"a", exact(bridge.a_n_m2)},
                    {"b", exact(bridge.b_n_m)},
                    {"c", exact(attraction_at_touch(bridge, radius))},
                    {"liquid_volume", exact(bridge.liquid_volume_m3)},
                    {"surface_energy", exact(contact.surface_energy_j_m2)},
                    {"cohesion", exact(cohesion_n(contact, pair))},
                    {"touch_excess", exact(touch_excess_n(contact, pair))},
                    {"passage", exact(kPassage * radius)},
                    {"formation_gap", exact(gaps.formation_m)},
                    {"rupture_gap", exact(gaps.rupture_m)},
                    {"walls", names},
                    {"materials", materials},
                    {"restitution", restitution},
                    {"friction", friction},
                    {"krot", exact(rolls ? 2.25 * lever * lever / constants.tangential_ratio : 0)},
                    {"eta", exact(rolls ? contact.rolling_friction * pair.effective_radius_m() : 0)},
                    {"density", grain_density_in_words(scene)},
                    {"time_step", exact(deck_time_step_s(scene))},
                    {"grain_density", exact(scene.grain_density_kg_m3)}});
}

std::string slump_script(const SlumpTest& test) {
  return filled_in("exports/texts/yade_slump.py", {{"mould_base_radius", exact(test.mould.base_radius_m)},
                                                   {"mould_top_radius", exact(test.mould.top_radius_m)},
                                                   {"mould_height", exact(test.mould.height_m)},
                                                   {"lift_velocity", exact(test.lift_velocity_m_s)}});
}

std::string two_grains_script(const ExportScene& scene, const ContactModel& contact) {
  const Distances distances = two_grain_distances(contact, scene.radius_m());
  return filled_in("exports/texts/yade_two_grains.py",
                   {{"nearest", exact(distances.nearest_m)}, {"farthest", exact(distances.farthest_m)}});
}

}  // namespace

Result<Export> export_yade(const ExportScene& scene) {
  const ContactModel& card = scene.contact();
  KnownLaws known{"Yade's Mindlin law",
                  {NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt, NormalLaw::sjkr},
                  kAllRolling,
                  kAllAttractions};
  if (card.normal == NormalLaw::jkr) known.attraction = {BridgeShape::none};  // its DMT excludes a second attraction
  Faults faults = unknown_laws(card, known);
  for (const auto& [name, wall] : scene.walls())
    if (wall.cohesion_factor > 0)
      faults.push_back({"test." + name + "_wall.cohesion_factor",
                        "is not 0, but the module attracts grains to grains only",
                        "calibrate with " + name + "_cohesion_factor 0"});
  if (!faults.empty()) return faults;

  const double radius = scene.radius_m();
  const ContactModel contact = with_nearest_law(card, NormalLaw::dmt, radius);
  const Sticking sticking = sticking_of(contact, 0.5 * radius);
  Export out;
  out.notes = differences_of_sticking(scene, contact, "Yade", sticking.load_n);
  if (sticking.pull_off_n > 0 || contact.bridge.shape != BridgeShape::none)
    out.notes.push_back(
        "The attraction, with formation, memory and rupture of bridges, runs in Python at every step, which is slow: "
        "use thousands of grains, not millions.");
  const double pull = sticking.pull_off_n + cohesion_n(contact, scene.mean_pair());
  if (contact.normal == card.normal && contact.friction_basis != FrictionBasis::elastic && pull > 0)
    out.notes.push_back(
        format("Yade limits friction by the elastic force, the card by a force that includes the attraction. A contact "
               "that is pressed only by its own attraction (%.3g N) resists sliding with up to %.3g N in Yade and %.3g "
               "N with the card's law.",
               pull, contact.friction * pull, contact.friction * held_normal_force_n(contact, sticking)));
  if (contact.rolling != RollingModel::none && contact.rolling_friction > 0)
    out.notes.push_back(
        "Rolling: the spring and the largest moment are those of two mean grains, on walls too; there is no dashpot.");
  const double weight = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * scene.grain_density_kg_m3 * kGravity;
  if (const auto note = note_of_constant_torque(scene, 10 * weight); !note.empty()) out.notes.push_back(note);
  out.files = {{"material.py", module_of(scene, contact)}, {"two_grains.py", two_grains_script(scene, contact)}};
  if (contact.normal != card.normal) out.files.push_back(sticking_curves(scene, contact, "yade"));
  if (const SlumpTest* test = scene.slump()) {
    if (test->drop) out.notes.push_back("The script simulates step 1 only, without the drop of the plate (step 2).");
    out.files.push_back({"slump.py", slump_script(*test)});
    out.files.push_back(grains_csv(scene));
  }
  if (contact.normal != card.normal)
    out.own_law = R"("contact": {"normal": "dmt", "attraction": "none"}, with "adhesion_pa" free)";
  out.instructions = "yade -n -x SCRIPT, which is slump.py or two_grains.py\n";
  if (scene.slump()) out.heap = "heap.dump";
  return out;
}

}  // namespace pastefit
