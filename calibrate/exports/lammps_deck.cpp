#include "calibrate/exports/lammps_deck.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/object_writer.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/store/program.h"
#include "core/laws/constants.h"
#include "core/laws/epa.h"
#include "core/step/time_step.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

constexpr double kRelaxDrag = 40;     // [1/s], same as pastefit's relaxation of the filling
constexpr double kGroundDepth = 0.1;  // [m] below the table, same as in pastefit

std::string header(const ExportScene& scene, const std::vector<std::string>& notes) {
  std::string out = deck_comment(scene.title) + "# written by " + program_identity() + " from a material card\n";
  if (!notes.empty()) out += "#\n# What is lost or changed:\n";
  for (const auto& note : notes) out += deck_comment("- " + note);
  return out +
         "#\n#   lmp_pastefit -in DECK                  one core\n#   mpirun -np 2 lmp_pastefit -in DECK     two "
         "ranks\n";
}

std::string full(double value) {
  return format("%.17g", value);
}

/// Walls of the test. A slump test also has a ground, for grains that leave the table.
std::vector<ExportWall> walls_in_deck(const ExportScene& scene) {
  auto walls = scene.walls();
  if (!scene.slump()) return walls;
  walls.push_back({"ground", scene.slump()->table_wall});
  walls.back().contact.rolling_friction = 1;  // same as in pastefit
  return walls;
}

/// Fixes of the walls; their laws are the variables NAME_law.
std::string wall_fixes(const ExportScene& scene, const std::string& before = "") {
  std::string out;
  for (const ExportWall& wall : walls_in_deck(scene))
    out += before + "fix          " + wall.name + " all wall/pastefit " + wall.name + " ${" + wall.name + "_law}\n";
  return out;
}

/// A law's JSON as words of a command: " &" and one name with its value per line, or all on one line. Nested names
/// include their path.
std::string words_of(const nlohmann::json& object, const char* between, const std::string& path = "") {
  std::string out;
  for (const auto& [name, value] : object.items()) {
    if (value.is_object())
      out += words_of(value, between, path + name + ".");
    else if (!value.is_null())
      out += between + path + name + " " + (value.is_string() ? value.get<std::string>() : exact(value.get<double>()));
  }
  return out;
}

std::string contact_words(const ContactModel& contact) {
  nlohmann::json words;
  ObjectWriter writer(words);
  describe_contact(writer, contact);
  if (contact.bridge.shape == BridgeShape::none) words.erase("bridge");
  return words_of(words, " &\n             ");
}

std::string wall_laws(const ExportScene& scene) {
  std::string out;
  for (const ExportWall& wall : walls_in_deck(scene)) {
    nlohmann::json words;
    ObjectWriter writer(words);
    describe_wall(writer, wall.contact);
    out += "variable     " + wall.name + "_law string \"" + words_of(words, " ").substr(1) + "\"\n";
  }
  return out;
}

/// Drag of each size class with equal deceleration.
std::string drag(const ExportScene& scene) {
  const auto& sizes = scene.sizes.radii_m;
  const double mass = 4.0 / 3.0 * std::numbers::pi * sizes[0] * sizes[0] * sizes[0] * scene.grain_density_kg_m3;
  std::string out = format("%.10g", kRelaxDrag * mass);
  for (std::size_t i = 1; i < sizes.size(); ++i)
    out += format(" scale %zu %.10g", i + 1, std::pow(sizes[i] / sizes[0], 3));
  return out;
}

/// Step 2. The plate is turned up with pastefit's motion, then falls under its weight and that of the heap.
std::string drop_of(const DropPlate& drop) {
  return filled_in("exports/texts/lammps_drop.in", {{"duration", shown(drop.lift_duration_s)},
                                                    {"duration_exact", full(drop.lift_duration_s)},
                                                    {"angle", full(-std::asin(drop.lift_height_m / drop.length_m))},
                                                    {"mass", full(drop.mass_kg)},
                                                    {"inertia", full(drop.mass_kg * drop.length_m * drop.length_m / 3)},
                                                    {"arm", full(0.5 * drop.length_m)}});
}

/// The table is tilted with the heap of step 1 on it (core/apparatus/slump/tilt.h).
std::string tilt_of(const SlumpTest& test, double grain_density) {
  return filled_in("exports/texts/lammps_tilt.in",
                   {{"rate", full(test.tilt->rate_deg_s)},
                    {"rate_rad", full(test.tilt->rate_deg_s / degrees)},
                    {"unit_sphere_mass", full(4.0 / 3 * std::numbers::pi * grain_density)},
                    {"slide", full(test.tilt->slide_m)},
                    {"half", full(0.5 * test.table_length_m)},
                    {"steepest", full(kSteepest)}});
}

/// material.inc: laws only, included after the grains by decks and by users' scripts.
std::string material_file(const ExportScene& scene) {
  return filled_in("exports/texts/lammps_material.in", {{"title", deck_comment(scene.title)},
                                                        {"program", program_identity()},
                                                        {"density", grain_density_in_words(scene)},
                                                        {"radius", format("%.9g", scene.radius_m())},
                                                        {"time_step", shown(deck_time_step_s(scene))},
                                                        {"walls", wall_fixes(scene, "#   ")},
                                                        {"reference_radius", exact(scene.radius_m())},
                                                        {"contact", contact_words(scene.contact())},
                                                        {"wall_laws", wall_laws(scene)}});
}

/// Slump test: relax in the mould, lift, rest; with a drop plate also step 2: turn the plate up, rest, drop, rest; with
/// a tilt, tilt the table.
/// Notes become comments.
std::string slump_deck(const ExportScene& scene, const std::vector<std::string>& notes) {
  const SlumpTest& test = *scene.slump();
  const double half = 0.5 * (test.drop ? test.drop->length_m : test.table_length_m);
  const bool falls = test.drop && test.drop->motion == TableMotion::hinged, turns = falls || test.tilt;
  return filled_in("exports/texts/lammps_slump.in",
                   {{"header", header(scene, notes)},
                    {"skin", shown(0.15 * scene.sizes.radii_m[0])},
                    {"time_step", shown(deck_time_step_s(scene))},
                    {"half", full(half)},
                    {"middle", full(-0.5 * kGroundDepth)},
                    {"tilt", turns ? "variable     tilt equal 0" : ""},
                    {"turning", turns ? " rotate v_tilt " + full(-half) + " 0 0 0 1 0" : ""},
                    {"ground", full(-kGroundDepth)},
                    {"base_radius", full(test.mould.base_radius_m)},
                    {"top_radius", full(test.mould.top_radius_m)},
                    {"height", full(test.mould.height_m)},
                    {"walls", wall_fixes(scene)},
                    {"drag", drag(scene)},
                    {"velocity", full(test.lift_velocity_m_s)},
                    {"lift_time", shown(1.2 * test.mould.height_m / test.lift_velocity_m_s)},
                    {"drop", falls       ? drop_of(*test.drop)
                             : test.tilt ? tilt_of(test, scene.grain_density_kg_m3)
                                         : ""}});
}

std::string two_grains_deck(const ExportScene& scene, const std::vector<std::string>& notes) {
  const double radius = scene.sizes.radii_m[0];
  const auto legs = two_grain_legs(scene.contact(), radius);
  std::string ways;
  for (std::size_t i = 0; i < legs.size(); ++i)
    ways += filled_in("exports/texts/lammps_leg.in", {{"word", legs[i].word},
                                                      {"steps", std::to_string(legs[i].steps)},
                                                      {"number", std::to_string(i + 1)},
                                                      {"way", full((legs[i].to_m - legs[i].from_m) / legs[i].steps)}});
  return filled_in("exports/texts/lammps_two_grains.in", {{"header", header(scene, notes)},
                                                          {"near", shown(4 * radius)},
                                                          {"far", shown(8 * radius)},
                                                          {"types", std::to_string(scene.sizes.radii_m.size())},
                                                          {"first", full(legs[0].from_m)},
                                                          {"diameter", full(2 * radius)},
                                                          {"density", full(scene.grain_density_kg_m3)},
                                                          {"skin", shown(0.15 * radius)},
                                                          {"legs", ways}});
}

}  // namespace

double deck_time_step_s(const ExportScene& scene) {
  const auto& contact = scene.contact();
  double smallest = std::ranges::min(scene.sizes.radii_m);
  if (!scene.slump() && scene.grains().distribution != SizeDistribution::mono) smallest = scene.grains().smallest_m;
  const double rayleigh = std::numbers::pi * smallest *
                          std::sqrt(scene.grain_density_kg_m3 / shear_modulus_pa(contact)) /
                          (0.1631 * contact.poissons_ratio + 0.8766);
  const double mass = 4.0 / 3 * std::numbers::pi * std::pow(smallest, 3) * scene.grain_density_kg_m3;
  const PairConstants pair = grain_pair(contact, scene.radius_m());
  double step = std::min(0.1 * rayleigh, 0.5 * viscous_step(pair, smallest, mass));
  if (yields(contact.normal)) step /= std::sqrt(pair.stiffening);
  if (contact.normal == NormalLaw::luding)
    step = std::min(step, 0.04 * Luding::collision_time(pair, 0.5 * smallest, 0.5 * mass, 1));
  const double digit = std::pow(10, std::floor(std::log10(step)) - 1);
  return std::floor(step / digit) * digit;
}

std::vector<std::string> lammps_dumps(const ExportScene& scene) {
  if (!scene.slump()) return {};
  std::vector<std::string> names{"filled.dump", "heap.dump"};
  if (scene.slump()->drop) names.push_back("heap2.dump");
  return names;
}

std::vector<ExportFile> lammps_deck(const ExportScene& scene, const std::vector<std::string>& notes) {
  const ExportFile material{"material.inc", material_file(scene)};
  if (!scene.slump()) return {{"in.two_grains", two_grains_deck(scene, notes)}, material};
  const SlumpTest& test = *scene.slump();
  const double heights =
      2 + (test.tilt ? test.table_length_m / test.mould.height_m : 0);  // a tilted table lifts the heap
  const DataFile data{static_cast<int>(scene.sizes.radii_m.size()), true, -kGroundDepth, heights, " # sphere"};
  return {{kLammpsDeck, slump_deck(scene, notes)},
          {"in.two_grains", two_grains_deck(scene, {})},
          material,
          {"grains.data", grains_data(scene, data)}};
}

std::string grains_data(const ExportScene& scene, const DataFile& file) {
  const SlumpTest& test = *scene.slump();
  const Packing& grains = scene.packing;
  const double margin = 4 * std::ranges::max(grains.radii);
  const double half = std::max(test.table_length_m, 4 * test.mould.height_m) + margin;
  std::string out = "grains of a filled mould, written by pastefit\n\n";
  out += format("%zu atoms\n%d atom types\n\n", grains.centres.size(), file.types);
  out += format("%.9g %.9g xlo xhi\n%.9g %.9g ylo yhi\n%.9g %.9g zlo zhi\n\n", -half, half, -half, half,
                file.lowest_m - margin, file.mould_heights * test.mould.height_m + margin);
  out += std::string("Atoms") + file.style + "\n\n";
  for (std::size_t i = 0; i < grains.centres.size(); ++i)
    out += format("%zu %d %.17g %.17g %.17g %.17g %.17g\n", i + 1, file.by_size ? scene.sizes.class_of[i] + 1 : 1,
                  2 * grains.radii[i], scene.grain_density_kg_m3, grains.centres[i].x, grains.centres[i].y,
                  grains.centres[i].z);
  return out;
}

namespace {

/// Stream over the words of a line, with C numbers in every locale.
std::istringstream line_stream(const std::string& line) {
  std::istringstream words(line);
  words.imbue(std::locale::classic());
  return words;
}

/// "Loop time of 1.5 on 2 procs ...".
bool is_loop(const std::string& line, double& seconds, int& ranks) {
  std::string loop, time, of, on;
  auto words = line_stream(line);
  words >> loop >> time >> of >> seconds >> on >> ranks;
  constexpr double longest_s = 1e9;
  constexpr int most_ranks = 10'000'000;
  const bool possible = seconds >= 0 && seconds <= longest_s && ranks >= 1 && ranks <= most_ranks;
  return words && possible && loop == "Loop" && time == "time" && of == "of" && on == "on";
}

/// "slide angle 18.5 degrees".
bool is_slide_angle(const std::string& line, double& angle_deg) {
  std::string slide, angle;
  return line_stream(line) >> slide >> angle >> angle_deg && slide == "slide" && angle == "angle";
}

/// "99.5% CPU use with ...".
bool is_share(const std::string& line, double& percent) {
  constexpr double most_percent = 1e5;
  return line.find("% CPU use") != std::string::npos && line_stream(line) >> percent && percent > 0 &&
         percent <= most_percent;
}

}  // namespace

LammpsLog read_lammps_log(std::string_view text) {
  LammpsLog log;
  double loop_s = 0, share = 1;
  const auto end_of_loop = [&] {
    log.wall_s += loop_s;
    log.core_s += loop_s * share * log.ranks;
    loop_s = 0;
    share = 1;
  };
  while (!text.empty()) {
    const std::string line(next_line(text));
    double seconds = 0, percent = 0;
    int ranks = 0;
    if (line.starts_with("LAMMPS (")) {
      if (log.copies++ == 0) log.program = line;
    } else if (line.starts_with("ERROR")) {
      if (log.error.empty()) log.error = line;
    } else if (is_loop(line, seconds, ranks)) {
      end_of_loop();
      loop_s = seconds;
      log.ranks = std::max(log.ranks, ranks);
    } else if (is_share(line, percent)) {
      share = percent / 100;
    } else if (double angle = 0; is_slide_angle(line, angle)) {
      log.slide_angle_deg = angle;
    } else if (line.starts_with("Total wall time:")) {
      log.ended = true;
    }
  }
  end_of_loop();
  return log;
}

}  // namespace pastefit
