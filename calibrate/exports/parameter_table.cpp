#include "calibrate/exports/parameter_table.h"

#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

void add_wall(std::vector<ParameterRow>& rows, const std::string& name, const WallContact& wall) {
  rows.push_back({name + ".youngs_modulus_pa", wall.youngs_modulus_pa, "of the wall"});
  rows.push_back({name + ".poissons_ratio", wall.poissons_ratio, "of the wall"});
  rows.push_back({name + ".restitution", wall.restitution, "grain on wall"});
  rows.push_back({name + ".friction", wall.friction, "grain on wall"});
  rows.push_back({name + ".rolling_friction", wall.rolling_friction, "grain on wall"});
  rows.push_back({name + ".cohesion_factor", wall.cohesion_factor, "share of the grains' attraction that acts here"});
}

void add_bridge(std::vector<ParameterRow>& rows, const ContactModel& contact, double radius) {
  const Bridge& bridge = contact.bridge;
  const GrainPair pair{radius, radius, radius};
  const BridgeGaps gaps = bridge_gaps(contact, pair);
  rows.push_back({"cohesion_n", cohesion_n(contact, pair), "constant attraction of overlapping grains"});
  if (bridge.shape == BridgeShape::polynomial)
    rows.insert(rows.end(), {{"a_n_m2", bridge.a_n_m2, "bridge a d^2 + b d + c"},
                             {"b_n_m", bridge.b_n_m, "bridge a d^2 + b d + c"}});
  if (bridge.shape == BridgeShape::capillary)
    rows.insert(rows.end(), {{"liquid_volume_m3", bridge.liquid_volume_m3, "of a bridge"},
                             {"surface_tension_n_m", bridge.surface_tension_n_m, "of the liquid"}});
  rows.insert(rows.end(), {{"c_n", attraction_at_touch(bridge, radius), "attraction of two grains that just touch"},
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

}  // namespace

std::string laws_chosen(const ContactModel& contact) {
  return "normal " + word_of(contact.normal, normal_laws) + ", bridge " + word_of(contact.bridge.shape, bridge_shapes) +
         ", formed by " + word_of(contact.bridge.formation, bridge_formations) + ", rolling " +
         word_of(contact.rolling, rolling_models) + ", friction of the " +
         word_of(contact.friction_basis, friction_bases) + " normal force";
}

std::vector<ParameterRow> parameter_rows(const ExportScene& scene) {
  const Specimen& specimen = specimen_of(scene.test);
  const ContactModel& contact = specimen.contact;
  const double radius = specimen.grains.radius_m;
  std::vector<ParameterRow> rows{
      {"grain_radius_m", radius, "mean radius, to which the bridge's numbers belong"},
      {"grain_density_kg_m3", scene.card_density_kg_m3.value_or(scene.grain_density_kg_m3), "of the grains"},
      {"bulk_density_kg_m3", specimen.bulk_density_kg_m3, "of the material as the laboratory prepares it"},
      {"youngs_modulus_pa", contact.youngs_modulus_pa, "of the grains"},
      {"poissons_ratio", contact.poissons_ratio, "of the grains"},
      {"restitution", contact.restitution, "grain on grain, without attraction"},
      {"friction", contact.friction, "grain on grain"},
      {"rolling_friction", contact.rolling_friction, "grain on grain, lever over effective radius r1 r2/(r1 + r2)"},
      {"time_step_s", deck_time_step_s(scene), "at most: a tenth of the Rayleigh time"}};
  if (const GrainSizes& grains = specimen.grains; grains.distribution != SizeDistribution::mono)
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
  if (contact.bridge.shape != BridgeShape::none) add_bridge(rows, contact, radius);
  if (const auto* slump = scene.slump())
    rows.insert(rows.end(), {{"mould_base_radius_m", slump->mould.base_radius_m, "apparatus"},
                             {"mould_top_radius_m", slump->mould.top_radius_m, "apparatus"},
                             {"mould_height_m", slump->mould.height_m, "apparatus"},
                             {"lift_velocity_m_s", slump->lift_velocity_m_s, "of the mould"}});
  for (const ExportWall& wall : walls_of(scene.test)) add_wall(rows, wall.name, wall.contact);
  return rows;
}

ExportFile parameters_csv(const ExportScene& scene) {
  std::string text = "name,value,meaning\n";
  for (const auto& row : parameter_rows(scene))
    text += row.name + "," + exact(row.value) + ",\"" + row.meaning + "\"\n";
  return {"parameters.csv", text};
}

ExportFile force_csv(const ExportScene& scene) {
  const Specimen& specimen = specimen_of(scene.test);
  const double radius = specimen.grains.radius_m;
  std::string text = "overlap_m,attraction_n,repulsion_n\n";
  for (const auto& point : force_table(specimen.contact, {radius, radius, radius}, 0.1 * radius, 2001))
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
  files.push_back(parameters_csv(scene));
  if (scene.contact().normal == NormalLaw::hertz) files.push_back(force_csv(scene));
  if (!scene.packing.centres.empty()) files.push_back(grains_csv(scene));
  return files;
}

namespace {

/// Elasto-plastic adhesion, core/laws/epa.h.
std::string yielding_in_words(NormalLaw normal) {
  const bool linear = normal == NormalLaw::luding;
  return std::string(
             "  d > 0, normal      F = k1 d^m on loading, k2 (d^m - l D^m) on un- and reloading, -kc d^m on the\n"
             "                     adhesion branch, less s^2 cohesion_n; besides 2 sqrt(5/6) beta sqrt(S_n m*) v_n\n") +
         (linear ? "                     m = 1, k1 = 4/3 E* R*, S_n = k1"
                 : "                     m = 3/2, k1 = 4/3 E* sqrt(R*), S_n = 2 E* sqrt(R* d)") +
         R"(, k2 = k1/(1 - l), D the deepest overlap of the
                     contact, which shrinks on the adhesion branch: D^m = d^m (1 + (1 - l) kc/k1)/l
                     beta = -ln e/sqrt(ln^2 e + pi^2), v_n the speed of approach
  d > 0, tangential  spring S_t = 4 G*/E* S_n on the slip, damper 2 sqrt(5/6) beta sqrt(S_t m*), at most mu times
                     F + s^2 cohesion_n + kc d^m
)";
}

}  // namespace

std::string laws_in_words(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  std::string out =
      R"(The contact law of two grains. d is the overlap: positive when they overlap, negative across a gap.
R* = r1 r2/(r1 + r2), m* = m1 m2/(m1 + m2), 1/E* = 2 (1 - nu^2)/E, 1/G* = 4 (2 - nu)(1 + nu)/E, s = 2 R*/R.

)";
  out +=
      yields(contact.normal) ? yielding_in_words(contact.normal)
      : contact.normal == NormalLaw::jkr
          ? R"(  contact, normal      4 E* a^3/(3 R*) - 4 sqrt(pi gamma E*) a^1.5, d = a^2/R* - sqrt(4 pi gamma a/E*), once the
                       grains have touched, until d < -3 a_t^2/R*, a_t^3 = pi gamma R*^2/(4 E*); gamma the surface
                       energy; besides 2 sqrt(5/6) beta sqrt(S_n m*) v_n - s^2 cohesion_n (the latter for d > 0)
                       S_n = 2 E* a, beta = -ln e/sqrt(ln^2 e + pi^2), v_n the speed of approach
  contact, tangential  spring S_t = 8 G* a on the slip, damper 2 sqrt(5/6) beta sqrt(S_t m*), at most mu N
)"
          : R"(  d > 0, normal      4/3 E* sqrt(R*) d^1.5 + 2 sqrt(5/6) beta sqrt(S_n m*) v_n - s^2 cohesion_n
                     S_n = 2 E* sqrt(R* d), beta = -ln e/sqrt(ln^2 e + pi^2), v_n the speed of approach
  d > 0, tangential  spring S_t = 8 G* sqrt(R* d) on the slip, damper 2 sqrt(5/6) beta sqrt(S_t m*), at most mu N
)";
  if (contact.rolling == RollingModel::spring_dashpot)
    out += "  d > 0, rolling     spring 2.25 S_n (mu_r R*)^2 and dashpot, at most mu_r N R* (Ai et al. 2011)\n";
  if (contact.rolling == RollingModel::constant_torque)
    out += "  d > 0, rolling     torque mu_r N R* against the relative spin\n";
  if (contact.bridge.shape != BridgeShape::none)
    out += "  d <= 0, bridge     " + bridge_formula(contact.bridge.shape) + R"(, attraction,
                     from touch to rupture at d = s d_c; it forms when the gap falls to s formation_gap_m, and lives
                     until the gap exceeds s |d_c|
)";
  if (touch_excess_n(contact, scene.mean_pair()) != 0)
    out += format(
        "  d > 0, cohesion    passes over from the bridge's s^2 c at touch to s^2 cohesion_n in a straight line,\n"
        "                     as far as d = s %.6g m\n",
        kPassage * scene.radius_m());
  out += "\nHere: " + laws_chosen(contact) + ".\n\n";
  for (const auto& row : parameter_rows(scene))
    out += format("  %-28s %16.9g   %s\n", row.name.c_str(), row.value, row.meaning.c_str());
  return out;
}

Result<Export> export_csv(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const KnownLaws known{"the force table", {NormalLaw::hertz, NormalLaw::epa, NormalLaw::luding}, kAllRolling};
  if (Faults faults = unknown_laws(contact, known); !faults.empty()) return faults;
  if (yields(contact.normal))
    return Export{law_files(scene),
                  {"The laws: " + laws_chosen(contact) + ".",
                   "There is no force table: the force depends on how deep the grains were pressed before."}};
  return Export{law_files(scene),
                {"The laws: " + laws_chosen(contact) + ".",
                 "The force table has no memory: when a bridge forms is said by formation_gap_m in parameters.csv."}};
}

}  // namespace pastefit
