#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/base/foreign_text.h"
#include "calibrate/base/format.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/known_laws.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/exports/soulie.h"
#include "calibrate/store/program.h"
#include "calibrate/verify/force_curve.h"

namespace pastefit {

namespace {

/// The models of grains and walls in LIGGGHTS's words. Cohesion has to stand before rolling friction.
struct Models {
  std::string grains, walls;
};

Models models_of(const ContactModel& contact, bool attracts) {
  const bool constant = contact.rolling == RollingModel::constant_torque;
  const std::string rolling = contact.rolling == RollingModel::none || contact.rolling_friction == 0 ? ""
                              : constant ? " rolling_friction cdt"
                                         : " rolling_friction epsd";
  const std::string base = "model hertz tangential history";
  const std::string reduce = contact.friction_basis != FrictionBasis::elastic ? " tangential_reduce on" : "";
  if (contact.normal == NormalLaw::sjkr) {
    const std::string both = base + " cohesion sjkr2" + rolling + reduce;
    return {both, both};
  }
  return {base + (attracts ? " cohesion easo/capillary/viscous" : "") + rolling + (attracts ? reduce : ""),
          base + rolling};
}

/// A matrix over the grains and each wall; walls do not meet each other.
std::string pairs_of(const std::vector<double>& values) {
  std::string out = format("peratomtypepair %zu", values.size());
  for (std::size_t row = 0; row < values.size(); ++row)
    for (std::size_t column = 0; column < values.size(); ++column)
      out += format(" %.17g", values[std::min(row, column) == 0 ? std::max(row, column) : std::min(row, column)]);
  return out;
}

/// The value of the grains, then those of the walls.
template <class OfWall>
std::vector<double> by_type(const std::vector<ExportWall>& walls, double grains, const OfWall& of_wall) {
  std::vector<double> out{grains};
  for (const ExportWall& wall : walls) out.push_back(of_wall(wall.contact));
  return out;
}

std::string one_each(const std::vector<double>& values) {
  std::string out = "peratomtype";
  for (const double value : values) out += format(" %.17g", value);
  return out;
}

/// Energy density of sjkr2 by which a wall holds the grains as the card's does.
double energy_density(const ContactModel& card, const WallContact& wall, double radius) {
  if (card.normal == NormalLaw::sjkr) return card.cohesion_energy_density_pa * wall.cohesion_factor;
  return sjkr_energy_density(sticking_of(card, wall, radius).pull_off_n, radius,
                             0.75 * wall_pair(card, wall, radius).hertz);
}

/// `contact` is what is written, with the law that stands in for the card's.
std::string properties(const ExportScene& scene, const ContactModel& contact, const SoulieFit* fit) {
  const auto walls = walls_of(scene.test);
  std::string out = "# types: 1 grains";
  for (std::size_t i = 0; i < walls.size(); ++i) out += format(", %zu ", i + 2) + walls[i].name;
  const auto property = [&](int number, const std::string& name, const std::string& value) {
    out += format("fix p%d all property/global ", number) + name + " " + value + "\n";
  };
  out += "\n";
  property(
      1, "youngsModulus",
      one_each(by_type(walls, contact.youngs_modulus_pa, [](const auto& wall) { return wall.youngs_modulus_pa; })));
  property(2, "poissonsRatio",
           one_each(by_type(walls, contact.poissons_ratio, [](const auto& wall) { return wall.poissons_ratio; })));
  property(3, "coefficientRestitution",
           pairs_of(by_type(walls, contact.restitution, [](const auto& wall) { return wall.restitution; })));
  property(4, "coefficientFriction",
           pairs_of(by_type(walls, contact.friction, [](const auto& wall) { return wall.friction; })));
  property(5, "coefficientRollingFriction",
           pairs_of(by_type(walls, contact.rolling_friction, [](const auto& wall) { return wall.rolling_friction; })));
  property(6, "coefficientRollingViscousDamping", pairs_of(by_type(walls, 0.3, [](const auto&) { return 0.3; })));
  if (contact.normal == NormalLaw::sjkr) {
    // sjkr2 has twice the area of the card's law.
    auto halves = by_type(walls, contact.cohesion_energy_density_pa,
                          [&](const auto& wall) { return energy_density(scene.contact(), wall, scene.radius_m()); });
    for (double& value : halves) value *= 0.5;
    property(7, "cohesionEnergyDensity", pairs_of(halves));
  }
  if (!fit) return out;
  const double radius = fit->bridge.radius_m;
  // LIGGGHTS gives each bridge the share 1 - sqrt(3/4) of the liquid on one of two equal grains.
  const double grain = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  out += format("fix p7 all property/global surfaceLiquidContentInitial scalar %.17g\n",
                fit->bridge.volume_m3 / (grain * (1 - std::sqrt(0.75))));
  out += format("fix p8 all property/global surfaceTension scalar %.17g\n", fit->bridge.surface_tension_n_m);
  out += "fix p9 all property/global fluidViscosity scalar 0\n";
  property(10, "contactAngle", one_each(by_type(walls, 0, [](const auto&) { return 0; })));
  out += "fix p11 all property/global minSeparationDistanceRatio scalar 1.01\n";
  out += format("fix p12 all property/global maxSeparationDistanceRatio scalar %.17g\n",
                1.02 + 0.5 * fit->bridge.rupture_gap_m() / radius);
  return out;
}

/// material.inc: properties, pair style and the model of walls, for a script with types for the grains and each wall.
std::string liggghts_material(const ExportScene& scene, const ContactModel& contact, const Models& models,
                              const SoulieFit* fit) {
  const auto walls = walls_of(scene.test);
  std::string out = deck_comment(scene.title) + "# written by " + program_identity() + " from a material card\n";
  out += format("# Include it where the grains are there (read_data, create_box of %zu types), in a script with:\n",
                walls.size() + 1);
  out += "#   units lj, atom_style granular, atom_modify map array, newton off, communicate single vel yes\n";
  out += format("#   density of a grain %.9g kg/m^3, mean radius %.9g m, time steps of %.6g s at most\n",
                scene.grain_density_kg_m3, scene.radius_m(), deck_time_step_s(scene));
  for (std::size_t i = 0; i < walls.size(); ++i)
    out +=
        "#   fix " + walls[i].name +
        format(" all wall/gran ${wall_model} mesh n_meshes ... meshes ..., each fix mesh/surface file ... type %zu\n",
               i + 2);
  out += "\n" + properties(scene, contact, fit);
  out += "pair_style   gran " + models.grains + "\npair_coeff   * *\n";
  return out + "variable     wall_model string \"" + models.walls + "\"\n";
}

std::string liggghts_begin(const ExportScene& scene, const std::string& what, const std::vector<std::string>& notes) {
  std::string out = deck_comment(scene.title) + "# " + what + "; written by " + program_identity() + "\n";
  out += "# For LIGGGHTS-PUBLIC 3.8.0. Numbers are SI; \"units lj\" means \"as they are\" and, unlike \"units si\",\n";
  out += "# takes grains softer than 5 MPa.\n";
  for (const auto& note : notes) out += deck_comment("- " + note);
  return out + R"(
units        lj
atom_style   granular
atom_modify  map array
boundary     f f f
newton       off
communicate  single vel yes
)";
}

std::string liggghts_slump(const ExportScene& scene, const std::vector<std::string>& notes) {
  const SlumpTest& test = *scene.slump();
  const double step = deck_time_step_s(scene);
  const auto steps = [&](double seconds) { return static_cast<long>(std::ceil(seconds / step)); };
  std::string out = liggghts_begin(scene, "the slump test, step 1", notes);
  out += "# liggghts -in in.slump, or mpirun -np 2 liggghts -in in.slump\n\nread_data    grains.data\n";
  out += format("neighbor     %.6g bin\nneigh_modify delay 0\n", 0.3 * test.grains.radius_m);
  out += "include      material.inc\n";
  out += format("timestep     %.6g\nfix          weight all gravity 9.81 vector 0 0 -1\n", step);
  out += "fix          table all wall/gran ${wall_model} primitive type 3 zplane 0.0\n";
  out += "fix          cone all mesh/surface file mould.stl type 2\n";
  out += "fix          mould all wall/gran ${wall_model} mesh n_meshes 1 meshes cone\n";
  out += "fix          motion all nve/sphere\ncompute      energy all ke\ncompute      top all reduce max z\n";
  out += "thermo_style custom step c_energy c_top\nthermo       1000\nthermo_modify norm no lost error\n\n";
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(test.grains.radius_m, 3) * scene.grain_density_kg_m3;
  out += format("# relax in the mould, with drag\nfix          drag all viscous %.10g\nrun          %ld\n", 40 * mass,
                steps(0.25));
  out += "unfix        drag\n";
  out += "dump         filled all custom 1 filled.dump id type x y z radius\nrun          0\nundump       filled\n\n";
  out += format(
      "# step 1: the mould rises\nfix          lift all move/mesh mesh cone linear 0 0 %.17g\nrun          "
      "%ld\nunfix        lift\n\n",
      test.lift_velocity_m_s, steps(test.mould.height_m / test.lift_velocity_m_s));
  out += format("# the heap comes to rest\nrun          %ld\n", steps(2.0));
  return out + "dump         heap all custom 1 heap.dump id type x y z radius\nrun          0\n";
}

/// Grains are held and moved so slowly that damping does not count, with a step as long as need be.
std::string liggghts_two_grains(const ExportScene& scene, const ContactModel& contact, const SoulieFit* fit,
                                const std::vector<std::string>& notes) {
  constexpr int kDistances = 240;
  const double radius = scene.radius_m(), speed = 1e-9;
  const double nearest = two_grain_distances(contact, radius).nearest_m;
  const double farthest = 2 * radius + 1.05 * (fit ? fit->bridge.rupture_gap_m() : 0.05 * radius);
  std::string out = liggghts_begin(scene, "force of two grains against their distance; prints \"apart r F\"",
                                   scene.slump() ? std::vector<std::string>{} : notes);
  out += format("region       box block %.6g %.6g %.6g %.6g %.6g %.6g units box\ncreate_box   %zu box\n", -4 * radius,
                8 * radius, -4 * radius, 4 * radius, -4 * radius, 4 * radius, walls_of(scene.test).size() + 1);
  out += format("create_atoms 1 single 0 0 0 units box\ncreate_atoms 1 single %.17g 0 0 units box\n", nearest);
  out += format("set          type 1 diameter %.17g\nset          type 1 density %.17g\n", 2 * radius,
                scene.grain_density_kg_m3);
  out += format("neighbor     %.6g bin\nneigh_modify delay 0\n", 0.3 * radius);
  out += "include      material.inc\n";
  out += format("timestep     %.17g\n", (farthest - nearest) / kDistances / speed);
  out += "group        first id 1\ngroup        second id 2\n";
  out += format("fix          pull second move linear %.17g 0 0 units box\n", speed);
  out += "fix          hold first move linear 0 0 0 units box\n";
  out += "compute      push second reduce sum fx\ncompute      at second reduce sum x\n";
  out += "variable     push equal c_push\nvariable     at equal c_at\n";
  out += "thermo_style custom step c_push c_at\nfix          out all print 1 \"apart ${at} ${push}\"\n";
  return out + format("run          %d\n", kDistances);
}

std::string mould_stl(const Mould& mould) {
  constexpr int kSectors = 96, kBands = 4;
  std::string out = "solid mould\n";
  const auto corner = [&](int sector, int band) {
    const double angle = 2 * std::numbers::pi * sector / kSectors, share = static_cast<double>(band) / kBands;
    const double radius = mould.base_radius_m + share * (mould.top_radius_m - mould.base_radius_m);
    return format("  vertex %.9g %.9g %.9g\n", radius * std::cos(angle), radius * std::sin(angle),
                  share * mould.height_m);
  };
  const auto facet = [&](const std::string& a, const std::string& b, const std::string& c) {
    out += "facet normal 0 0 0\n outer loop\n" + a + b + c + " endloop\nendfacet\n";
  };
  for (int i = 0; i < kSectors; ++i)
    for (int k = 0; k < kBands; ++k) {
      const int next = (i + 1) % kSectors;
      facet(corner(i, k), corner(next, k), corner(next, k + 1));
      facet(corner(i, k), corner(next, k + 1), corner(i, k + 1));
    }
  return out + "endsolid mould\n";
}

/// As LAMMPS's, but grains keep their radii: the law belongs to no type.
std::string liggghts_data(const ExportScene& scene) {
  std::string out = "grains of a filled mould, written by pastefit\n\n";
  const SlumpTest& test = *scene.slump();
  const auto& grains = scene.packing.centres;
  const double margin = 4 * *std::ranges::max_element(scene.packing.radii);
  const double half = std::max(test.table_length_m, 4 * test.mould.height_m) + margin;
  out += format("%zu atoms\n3 atom types\n\n", grains.size());
  out += format("%.9g %.9g xlo xhi\n%.9g %.9g ylo yhi\n%.9g %.9g zlo zhi\n\nAtoms\n\n", -half, half, -half, half,
                -margin, 2.5 * test.mould.height_m + margin);
  for (std::size_t i = 0; i < grains.size(); ++i)
    out += format("%zu 1 %.17g %.17g %.17g %.17g %.17g\n", i + 1, 2 * scene.packing.radii[i], scene.grain_density_kg_m3,
                  grains[i].x, grains[i].y, grains[i].z);
  return out;
}

std::vector<std::string> liggghts_losses(const ExportScene& scene, const ContactModel& written, const SoulieFit* fit) {
  const ContactModel& contact = scene.contact();
  const GrainPair pair = scene.mean_pair();
  const Sticking deck = sticking_of(written, 0.5 * scene.radius_m());
  // Reduced, LIGGGHTS's friction is that of the force less its cohesion: nothing where grains only stick.
  std::vector<std::string> notes = differences_of_sticking(
      scene, written, "LIGGGHTS", contact.friction_basis == FrictionBasis::elastic ? deck.load_n : 0);
  if (fit) {
    const auto& difference = fit->difference;
    notes.push_back(
        format("LIGGGHTS has no such bridge. Its capillary bridge (easo, Soulie et al. 2006) was fitted "
               "to the card's curve: it differs by up to %.1f %% of the peak force, %.1f %% in root mean "
               "square, %+.1f %% in work.",
               100 * difference.largest, 100 * difference.root_mean_square, 100 * difference.work));
    notes.push_back(
        format("Liquid volume %.4g m^3 a bridge and surface tension %.4g N/m are numbers of the fit, not of a "
               "liquid. The contact angle is 0: at others LIGGGHTS 3.8.0 is wrong, by 27 %% at 30 degrees.",
               fit->bridge.volume_m3, fit->bridge.surface_tension_n_m));
    const auto gaps = bridge_gaps(contact, pair);
    if (gaps.formation_m > 0)
      notes.push_back(
          format("Bridges form when grains touch; on the card, at a gap of %.4g mm.", 1e3 * gaps.formation_m));
    const double cohesion = cohesion_n(contact, pair), touch = fit->bridge.force_n(0);
    notes.push_back(
        format("Overlapping grains attract each other with %.4g N; on the card with %.4g N.", touch, cohesion));
    if (scene.sizes.radii_m.size() > 1 || (!scene.slump() && scene.grains().distribution != SizeDistribution::mono))
      notes.push_back(
          "Between grains of other than the mean size the bridge scales as Soulie's, not with the square of "
          "the size.");
  }
  for (const auto& [name, wall] : walls_of(scene.test))
    if (wall.cohesion_factor > 0 && written.normal != NormalLaw::sjkr)
      notes.push_back(format("The attraction of grains to the %s (%.3g of that between grains) is lost.", name.c_str(),
                             wall.cohesion_factor));
  if (contact.rolling == RollingModel::spring_dashpot && contact.rolling_friction > 0)
    notes.push_back(
        "The rolling spring is two thirds of the card's (secant for tangent stiffness); the largest moment "
        "is the same.");
  if (scene.slump() && scene.slump()->drop)
    notes.push_back("The deck runs step 1. The drop of the plate, step 2, is not part of it.");
  return notes;
}

/// "gap_m,card_n,liggghts_n" of a fitted bridge.
ExportFile bridge_curves(const ExportScene& scene, const SoulieFit& fit) {
  std::string text = "gap_m,card_n,liggghts_n\n";
  const GrainPair pair = scene.mean_pair();
  const double farthest = 1.2 * std::max(fit.bridge.rupture_gap_m(), bridge_gaps(scene.contact(), pair).rupture_m);
  for (int i = 0; i <= 400; ++i) {
    const double gap = farthest * i / 400;
    text += format("%.17g,%.17g,%.17g\n", gap, attraction_n(scene.contact(), pair, -gap), fit.bridge.force_n(gap));
  }
  return {"curves.csv", text};
}

/// What LIGGGHTS 3.8.0 refuses when a deck starts (`0.05 < coefficientRestitution <= 1 required`).
Faults beyond_limits(const ExportScene& scene) {
  constexpr double kLeastRestitution = 0.05;
  Faults faults;
  const auto check = [&](const std::string& place, double restitution, const std::string& remedy) {
    if (restitution <= kLeastRestitution)
      faults.push_back({place,
                        format("is %g; LIGGGHTS takes a restitution above %g only", restitution, kLeastRestitution),
                        "calibrate with " + remedy + ", or export to another target"});
  };
  check("test.contact.restitution", scene.contact().restitution, "\"restitution\" 0.06 or more");
  for (const auto& [name, wall] : walls_of(scene.test))
    check("test." + name + "_wall.restitution", wall.restitution, "a wall of restitution 0.06 or more");
  return faults;
}

}  // namespace

Result<Export> export_liggghts(const ExportScene& scene) {
  const ContactModel& card = scene.contact();
  KnownLaws known{"LIGGGHTS", {NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt, NormalLaw::sjkr}, kAllRolling};
  if (card.normal != NormalLaw::hertz) known.attraction = {BridgeShape::none};  // it has one cohesion at a time
  Faults faults = unknown_laws(card, known);
  for (Fault& fault : beyond_limits(scene)) faults.push_back(std::move(fault));
  if (!faults.empty()) return faults;
  const double radius = scene.radius_m();
  const ContactModel contact = with_nearest_law(card, NormalLaw::sjkr, radius);
  const GrainPair pair = scene.mean_pair();
  const bool attracts = bridge_gaps(contact, pair).rupture_m > 0 && attraction_n(contact, pair, 0) > 0;
  const SoulieFit fit = attracts ? fit_soulie(contact, radius) : SoulieFit{};
  const SoulieFit* const fitted = attracts ? &fit : nullptr;
  Export out;
  out.notes = liggghts_losses(scene, contact, fitted);
  if (scene.slump())
    out.files = {{"in.slump", liggghts_slump(scene, out.notes)},
                 {"grains.data", liggghts_data(scene)},
                 {"mould.stl", mould_stl(scene.slump()->mould)}};
  out.files.push_back({"in.two_grains", liggghts_two_grains(scene, contact, fitted, out.notes)});
  out.files.push_back({"material.inc", liggghts_material(scene, contact, models_of(contact, attracts), fitted)});
  if (attracts) out.files.push_back(bridge_curves(scene, fit));
  if (contact.normal != card.normal) out.files.push_back(sticking_curves(scene, contact, "liggghts"));
  if (attracts || contact.normal != card.normal)
    out.own_law = R"("contact": {"normal": "sjkr", "attraction": "none"}, with "cohesion_energy_density_pa" free)";
  out.instructions = "liggghts -in DECK, which is in.slump or in.two_grains\n";
  if (scene.slump()) out.heap = "heap.dump";
  return out;
}

}  // namespace pastefit
