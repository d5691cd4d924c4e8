#include "calibrate/exports/liggghts_deck.h"

#include <cmath>
#include <numbers>

#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/store/program.h"

namespace pastefit {

namespace {

std::string liggghts_begin(const ExportScene& scene, const std::string& what, const std::vector<std::string>& notes) {
  std::string out = deck_comment(scene.title) + "# " + what + "; written by " + program_identity() + "\n";
  out += "# For LIGGGHTS-PUBLIC 3.8.0. Numbers are SI; \"units lj\" means \"as they are\" and, unlike \"units si\",\n";
  out += "# takes grains softer than 5 MPa.\n";
  for (const auto& note : notes) out += deck_comment("- " + note);
  return out + R"(
units        lj
atom_style   granular
)" + atom_modify(scene.contact()) +
         R"(
boundary     f f f
newton       off
communicate  single vel yes
)";
}

std::string slump_walls(const Models& models) {
  return "fix          table all wall/gran ${wall_model} primitive type 3 zplane 0.0" + models.wall_end() +
         "\nfix          mould all wall/gran ${wall_model} mesh n_meshes 1 meshes cone" + models.wall_end() + "\n";
}

/// Grains that fill the mould carry their loads on springs of the exponent 3/2. Before contacts on linear springs
/// remember how deep they were pressed, they come to rest on those: else light contacts would be pressed too hard.
struct Takeover {
  std::string before, after;  ///< commands, before the walls are there and once the grains are at rest

  Takeover(const ExportScene& scene, const Models& models, long steps) {
    const std::string forget = "unfix        unloading\nunfix        adhesion\n";
    before = "\n# elastic springs first, on which the grains come to rest\n" + forget + edinburgh_memory(scene, true) +
             models.pair_style();
    after = "# from now on contacts yield and adhere\nunfix        table\nunfix        mould\n" + forget +
            edinburgh_memory(scene, false) + models.pair_style() + slump_walls(models) +
            format("run          %ld\n", steps);
  }
};

/// Of LIGGGHTS only the way apart; of a law with memory the whole way.
std::vector<Leg> liggghts_legs(const ExportScene& scene, const Written& written) {
  const double radius = scene.radius_m();
  std::vector<Leg> legs = two_grain_legs(written.contact, radius);
  if (yields(written.contact.normal)) return legs;
  const double reach = written.fit ? written.fit->bridge.rupture_gap_m() : 0.05 * radius;
  return {{"apart", legs[0].from_m, 2 * radius + 1.05 * reach, 240}};
}

}  // namespace

std::string atom_modify(const ContactModel& contact) {
  return std::string("atom_modify map array") + (yields(contact.normal) ? " sort 0 0" : "");
}

std::string liggghts_slump(const ExportScene& scene, const Written& written, const Models& models,
                           const std::vector<std::string>& notes) {
  const SlumpTest& test = *scene.slump();
  const double step = written.time_step_s;
  const auto steps = [&](double seconds) { return static_cast<long>(std::ceil(seconds / step)); };
  std::string out = liggghts_begin(scene, "the slump test, step 1", notes);
  out += yields(scene.contact().normal) ? "# liggghts -in in.slump, on one process\n"
                                        : "# liggghts -in in.slump, or mpirun -np 2 liggghts -in in.slump\n";
  out += "\nread_data    grains.data\n";
  out += format("neighbor     %.6g bin\nneigh_modify delay 0\n", 0.3 * test.grains.radius_m);
  out += "include      material.inc\n";
  std::optional<Takeover> takeover;
  if (scene.contact().normal == NormalLaw::epa) takeover.emplace(scene, models, steps(0.1));
  if (takeover) out += takeover->before;
  out += format("timestep     %.6g\nfix          weight all gravity 9.81 vector 0 0 -1\n", step);
  out += "fix          cone all mesh/surface file mould.stl type 2\n" + slump_walls(models);
  out += "fix          motion all nve/sphere\ncompute      energy all ke\ncompute      top all reduce max z\n";
  out += "thermo_style custom step c_energy c_top\nthermo       1000\nthermo_modify norm no lost error\n\n";
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(test.grains.radius_m, 3) * scene.grain_density_kg_m3;
  out += format("# relax in the mould, with drag\nfix          drag all viscous %.10g\nrun          %ld\n", 40 * mass,
                steps(0.25));
  if (takeover) out += takeover->after;
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
std::string liggghts_two_grains(const ExportScene& scene, const Written& written,
                                const std::vector<std::string>& notes) {
  const double radius = scene.radius_m(), speed = 1e-9;
  const auto legs = liggghts_legs(scene, written);
  const std::string word = legs[0].word;
  std::string out = liggghts_begin(scene, "force of two grains against their distance; prints \"" + word + " r F\"",
                                   scene.slump() ? std::vector<std::string>{} : notes);
  out += format("region       box block %.6g %.6g %.6g %.6g %.6g %.6g units box\ncreate_box   %zu box\n", -4 * radius,
                8 * radius, -4 * radius, 4 * radius, -4 * radius, 4 * radius, walls_of(scene.test).size() + 1);
  out += format("create_atoms 1 single 0 0 0 units box\ncreate_atoms 1 single %.17g 0 0 units box\n", legs[0].from_m);
  out += format("set          type 1 diameter %.17g\nset          type 1 density %.17g\n", 2 * radius,
                scene.grain_density_kg_m3);
  out += format("neighbor     %.6g bin\nneigh_modify delay 0\n", 0.3 * radius);
  out += "include      material.inc\n";
  out += format("timestep     %.17g\n", std::fabs(legs[0].to_m - legs[0].from_m) / legs[0].steps / speed);
  out += "group        first id 1\ngroup        second id 2\n";
  out += "fix          hold first move linear 0 0 0 units box\n";
  out += "compute      push second reduce sum fx\ncompute      at second reduce sum x\n";
  out += "variable     push equal c_push\nvariable     at equal c_at\n";
  out += "thermo_style custom step c_push c_at\nfix          out all print 1 \"" + word + " ${at} ${push}\"\n";
  for (const Leg& leg : legs)
    out += format("fix          pull second move linear %.17g 0 0 units box\nrun          %d\nunfix        pull\n",
                  std::copysign(speed, leg.to_m - leg.from_m), leg.steps);
  return out;
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

}  // namespace pastefit
