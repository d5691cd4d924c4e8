#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

struct ParameterRow {
  std::string name;  ///< with its unit
  double value = 0;
  std::string meaning;
};

void add_bridge(std::vector<ParameterRow>& rows, const ContactModel& contact, const GrainPair& pair) {
  const Bridge& bridge = contact.bridge;
  const BridgeGaps gaps = bridge_gaps(contact, pair);
  rows.push_back({"cohesion_n", cohesion_n(contact, pair), "constant attraction of overlapping grains"});
  if (bridge.shape == BridgeShape::polynomial)
    rows.insert(rows.end(), {{"a_n_m2", bridge.a_n_m2, "bridge a d^2 + b d + c"},
                             {"b_n_m", bridge.b_n_m, "bridge a d^2 + b d + c"}});
  if (bridge.shape == BridgeShape::capillary)
    rows.insert(rows.end(), {{"liquid_volume_m3", bridge.liquid_volume_m3, "of a bridge"},
                             {"surface_tension_n_m", bridge.surface_tension_n_m, "of the liquid"}});
  rows.insert(rows.end(), {{"c_n", attraction_at_touch(bridge, pair.reference_radius_m),
                            "attraction of two grains that just touch"},
                           {"d_c_m", -gaps.rupture_m, "overlap at which the bridge ruptures (negative: a gap)"},
                           {"offset_m", bridge.offset_m, "thickness of the liquid shell"},
                           {"formation_gap_m", gaps.formation_m, "gap at which a bridge forms"}});
}

std::string bridge_formula(BridgeShape shape) {
  switch (shape) {
    case BridgeShape::polynomial:
      return "a d^2 + s b d + s^2 c";
    case BridgeShape::linear:
      return "s^2 c (1 + d/(s |d_c|))";
    case BridgeShape::exponential:
      return "s^2 c exp(3 d/(s |d_c|))";
    case BridgeShape::capillary:
      return "s^2 c/(1 + 1.05 S + 2.5 S^2), S = -d/s sqrt(R/liquid volume)";
    default:
      return "s^2 F(d/s), F as in force.csv";
  }
}

/// Names of the laws in one line.
std::string laws_chosen(const ContactModel& contact) {
  return "normal " + word_of(contact.normal, normal_laws) + ", bridge " + word_of(contact.bridge.shape, bridge_shapes) +
         ", formed by " + word_of(contact.bridge.formation, bridge_formations) + ", rolling " +
         word_of(contact.rolling, rolling_models) + ", friction of the " +
         word_of(contact.friction_basis, friction_bases) + " normal force";
}

/// Contact laws, walls, grains and apparatus of the test in SI, for grains of mean radius.
std::vector<ParameterRow> parameter_rows(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  std::vector<ParameterRow> rows{
      {"grain_radius_m", scene.radius_m(), "mean radius, to which the bridge's numbers belong"},
      {"grain_density_kg_m3", scene.card_density_kg_m3.value_or(scene.grain_density_kg_m3), "of the grains"},
      {"bulk_density_kg_m3", specimen_of(scene.test).bulk_density_kg_m3,
       "of the material as the laboratory prepares it"},
      {"youngs_modulus_pa", contact.youngs_modulus_pa, "of the grains"},
      {"poissons_ratio", contact.poissons_ratio, "of the grains"},
      {"restitution", contact.restitution, "grain on grain, without attraction"},
      {"friction", contact.friction, "grain on grain"},
      {"rolling_friction", contact.rolling_friction, "grain on grain, lever over effective radius r1 r2/(r1 + r2)"},
      {"time_step_s", deck_time_step_s(scene), "at most: a tenth of the Rayleigh time"}};
  if (const GrainSizes& grains = scene.grains(); grains.distribution != SizeDistribution::mono)
    rows.insert(rows.begin() + 1,
                {{"smallest_radius_m", grains.smallest_m, "of the grains"},
                 {"largest_radius_m", grains.largest_m,
                  "of the grains, distribution " + word_of(grains.distribution, size_distributions)}});
  if (contact.surface_energy_j_m2 > 0)
    rows.push_back({"surface_energy_j_m2", contact.surface_energy_j_m2, "of the grains, half the work of adhesion"});
  if (contact.cohesion_energy_density_pa > 0)
    rows.push_back({"cohesion_energy_density_pa", contact.cohesion_energy_density_pa, "of the grains, over 2 pi R* d"});
  if (yields(contact.normal))
    rows.insert(rows.end(), {{"plasticity_ratio", contact.plasticity_ratio, "l = 1 - k1/k2"},
                             {"adhesion_ratio", contact.adhesion_ratio, "kc/k1"},
                             {"cohesion_n", cohesion_n(contact, scene.mean_pair()), "constant pull-off"}});
  if (contact.bridge.shape != BridgeShape::none) add_bridge(rows, contact, scene.mean_pair());
  if (const auto* slump = scene.slump())
    rows.insert(rows.end(), {{"mould_base_radius_m", slump->mould.base_radius_m, "apparatus"},
                             {"mould_top_radius_m", slump->mould.top_radius_m, "apparatus"},
                             {"mould_height_m", slump->mould.height_m, "apparatus"},
                             {"lift_velocity_m_s", slump->lift_velocity_m_s, "of the mould"}});
  for (const auto& [name, wall] : scene.walls())
    rows.insert(rows.end(),
                {{name + ".youngs_modulus_pa", wall.youngs_modulus_pa, "of the wall"},
                 {name + ".poissons_ratio", wall.poissons_ratio, "of the wall"},
                 {name + ".restitution", wall.restitution, "grain on wall"},
                 {name + ".friction", wall.friction, "grain on wall"},
                 {name + ".rolling_friction", wall.rolling_friction, "grain on wall"},
                 {name + ".cohesion_factor", wall.cohesion_factor, "share of the grains' attraction that acts here"}});
  return rows;
}

}  // namespace

ExportFile force_csv(const ExportScene& scene) {
  std::string text = "overlap_m,attraction_n,repulsion_n\n";
  for (const auto& point : force_table(scene.contact(), scene.mean_pair(), 0.1 * scene.radius_m(), 2001))
    text += exact(point.overlap_m) + "," + exact(point.attraction_n) + "," + exact(point.repulsion_n) + "\n";
  return {"force.csv", text};
}

ExportFile grains_csv(const ExportScene& scene) {
  std::string text = "x_m,y_m,z_m,radius_m\n";
  for (std::size_t i = 0; i < scene.packing.centres.size(); ++i) {
    const auto& p = scene.packing.centres[i];
    text += exact(p.x) + "," + exact(p.y) + "," + exact(p.z) + "," + exact(scene.packing.radii[i]) + "\n";
  }
  return {"grains.csv", text};
}

std::vector<ExportFile> law_files(const ExportScene& scene, std::vector<ExportFile> files) {
  std::string parameters = "name,value,meaning\n";
  for (const auto& row : parameter_rows(scene))
    parameters += row.name + "," + exact(row.value) + ",\"" + row.meaning + "\"\n";
  files.push_back({"parameters.csv", parameters});
  if (scene.contact().normal == NormalLaw::hertz) files.push_back(force_csv(scene));
  if (!scene.packing.centres.empty()) files.push_back(grains_csv(scene));
  return files;
}

namespace {

std::string normal_in_words(NormalLaw normal) {
  if (!yields(normal))
    return filled_in(normal == NormalLaw::jkr ? "exports/texts/law_jkr.txt" : "exports/texts/law_hertz.txt", {});
  return filled_in("exports/texts/law_yielding.txt",
                   {{"springs", normal == NormalLaw::luding ? "m = 1, k1 = 4/3 E* R*, S_n = k1"
                                                            : "m = 3/2, k1 = 4/3 E* sqrt(R*), S_n = 2 E* sqrt(R* d)"}});
}

std::string rolling_in_words(RollingModel rolling) {
  if (rolling == RollingModel::none) return "";
  return rolling == RollingModel::spring_dashpot
             ? "  d > 0, rolling     spring 2.25 S_n (mu_r R*)^2 and dashpot, at most mu_r N R* (Ai et al. 2011)"
             : "  d > 0, rolling     torque mu_r N R* against the relative spin";
}

}  // namespace

std::string laws_in_words(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  std::string bridge, cohesion, numbers;
  if (contact.bridge.shape != BridgeShape::none)
    bridge = "  d <= 0, bridge     " + bridge_formula(contact.bridge.shape) + R"(, attraction,
                     from touch to rupture at d = s d_c; it forms when the gap falls to s formation_gap_m, and lives
                     until the gap exceeds s |d_c|)";
  if (touch_excess_n(contact, scene.mean_pair()) != 0)
    cohesion = format(
        "  d > 0, cohesion    passes over from the bridge's s^2 c at touch to s^2 cohesion_n in a straight line,\n"
        "                     as far as d = s %.6g m",
        kPassage * scene.radius_m());
  for (const auto& row : parameter_rows(scene))
    numbers += format("  %-28s %16.9g   %s\n", row.name, row.value, row.meaning);
  return filled_in("exports/texts/laws.txt", {{"normal", normal_in_words(contact.normal)},
                                              {"rolling", rolling_in_words(contact.rolling)},
                                              {"bridge", bridge},
                                              {"cohesion", cohesion},
                                              {"chosen", laws_chosen(contact)},
                                              {"numbers", numbers}});
}

Result<Export> export_csv(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const KnownLaws known{"the force table", {NormalLaw::hertz, NormalLaw::epa, NormalLaw::luding}, kAllRolling};
  if (Faults faults = unknown_laws(contact, known); !faults.empty()) return faults;
  return Export{
      law_files(scene),
      {"The laws: " + laws_chosen(contact) + ".",
       yields(contact.normal)
           ? "There is no force table: the force depends on how deep the grains were pressed before."
           : "The force table has no memory: when a bridge forms is said by formation_gap_m in parameters.csv."}};
}

}  // namespace pastefit
