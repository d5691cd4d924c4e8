#include "calibrate/exports/liggghts_deck.h"

#include <cmath>
#include <numbers>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/application.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/store/program.h"

namespace pastefit {

namespace {

std::string slump_walls(const Models& models) {
  return "fix          table all wall/gran ${wall_model} primitive type 3 zplane 0.0" + models.wall_end() +
         "\nfix          mould all wall/gran ${wall_model} mesh n_meshes 1 meshes cone" + models.wall_end() + "\n";
}

/// Two-stage relaxation. Grains from the filling carry their loads on springs of exponent 3/2; they first settle on
/// linear springs without history, otherwise light contacts would be overloaded.
struct Takeover {
  std::string before, after;  ///< commands before the walls exist, and after the grains are at rest

  Takeover(const ExportScene& scene, const Models& models, long steps) {
    const std::string forget = "unfix        unloading\nunfix        adhesion\n";
    before = "\n# elastic springs first, on which the grains come to rest\n" + forget + edinburgh_memory(scene, true) +
             models.pair_style();
    after = "# from now on contacts yield and adhere\nunfix        table\nunfix        mould\n" + forget +
            edinburgh_memory(scene, false) + models.pair_style() + slump_walls(models) +
            format("run          %ld\n", steps);
  }
};

/// Separation only in LIGGGHTS; the whole motion for laws with history.
std::vector<Leg> liggghts_legs(const ExportScene& scene, const Written& written) {
  const double radius = scene.radius_m();
  std::vector<Leg> legs = two_grain_legs(written.contact, radius);
  if (yields(written.contact.normal)) return legs;
  const double reach = written.fit ? written.fit->bridge.rupture_gap_m() : 0.05 * radius;
  return {{"apart", legs[0].from_m, 2 * radius + 1.05 * reach, 240}};
}

}  // namespace

std::string liggghts_begin(const ExportScene& scene, const std::string& what, const std::vector<std::string>& notes) {
  const auto comment = [](const std::string& note) { return deck_comment("- " + note); };
  const std::string line = deck_comment(what);
  return filled_in("exports/texts/liggghts_header.in", {{"title", deck_comment(scene.title)},
                                                        {"what", line.substr(2, line.size() - 3)},
                                                        {"program", program_identity()},
                                                        {"notes", listed(notes, comment, "")},
                                                        {"atom_modify", atom_modify(scene.contact())}});
}

std::string atom_modify(const ContactModel& contact) {
  return std::string("atom_modify map array") + (yields(contact.normal) ? " sort 0 0" : "");
}

std::string liggghts_slump(const ExportScene& scene, const Written& written, const Models& models,
                           const std::vector<std::string>& notes) {
  const SlumpTest& test = *scene.slump();
  const auto steps = [&](double seconds) { return static_cast<long>(std::ceil(seconds / written.time_step_s)); };
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(test.grains.radius_m, 3) * scene.grain_density_kg_m3;
  std::optional<Takeover> takeover;
  if (scene.contact().normal == NormalLaw::epa) takeover.emplace(scene, models, steps(0.1));
  return filled_in(
      "exports/texts/liggghts_slump.in",
      {{"header", liggghts_begin(scene, "the slump test, step 1", notes)},
       {"use", yields(scene.contact().normal) ? "# liggghts -in in.slump, on one process"
                                              : "# liggghts -in in.slump, or mpirun -np 2 liggghts -in in.slump"},
       {"skin", shown(0.3 * test.grains.radius_m)},
       {"elastic", takeover ? takeover->before : ""},
       {"time_step", shown(written.time_step_s)},
       {"walls", slump_walls(models)},
       {"drag", format("%.10g", 40 * mass)},
       {"relax", std::to_string(steps(0.25))},
       {"plastic", takeover ? takeover->after : ""},
       {"velocity", format("%.17g", test.lift_velocity_m_s)},
       {"lift", std::to_string(steps(test.mould.height_m / test.lift_velocity_m_s))},
       {"rest", std::to_string(steps(2.0))}});
}

/// Grains are held and moved so slowly that damping is negligible; the step is as long as possible.
std::string liggghts_two_grains(const ExportScene& scene, const Written& written,
                                const std::vector<std::string>& notes) {
  const double radius = scene.radius_m(), speed = 1e-9;
  const auto legs = liggghts_legs(scene, written);
  const std::string word = legs[0].word;
  std::string ways;
  for (const Leg& leg : legs)
    ways += format("fix          pull second move linear %.17g 0 0 units box\nrun          %d\nunfix        pull\n",
                   std::copysign(speed, leg.to_m - leg.from_m), leg.steps);
  return filled_in(
      "exports/texts/liggghts_two_grains.in",
      {{"header", liggghts_begin(scene, "force of two grains against their distance; prints \"" + word + " r F\"",
                                 scene.slump() ? std::vector<std::string>{} : notes)},
       {"near", shown(4 * radius)},
       {"far", shown(8 * radius)},
       {"types", std::to_string(scene.walls().size() + 1)},
       {"first", format("%.17g", legs[0].from_m)},
       {"diameter", format("%.17g", 2 * radius)},
       {"density", format("%.17g", scene.grain_density_kg_m3)},
       {"skin", shown(0.3 * radius)},
       {"time_step", format("%.17g", std::fabs(legs[0].to_m - legs[0].from_m) / legs[0].steps / speed)},
       {"word", word},
       {"legs", ways}});
}

std::string mould_stl(const Mould& mould) {
  constexpr int kSectors = 96, kBands = 4;
  const auto corner = [&](int sector, int band) {
    const double angle = 2 * std::numbers::pi * sector / kSectors, share = static_cast<double>(band) / kBands;
    const double radius = mould.base_radius_m + share * (mould.top_radius_m - mould.base_radius_m);
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), share * mould.height_m};
  };
  std::vector<Triangle> facets;
  for (int i = 0; i < kSectors; ++i)
    for (int k = 0; k < kBands; ++k) {
      const int next = (i + 1) % kSectors;
      facets.push_back({corner(i, k), corner(next, k), corner(next, k + 1)});
      facets.push_back({corner(i, k), corner(next, k + 1), corner(i, k + 1)});
    }
  return stl_text("mould", facets);
}

}  // namespace pastefit
