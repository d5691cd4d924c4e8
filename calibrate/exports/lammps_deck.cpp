#include "calibrate/exports/lammps_deck.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <numbers>
#include <sstream>
#include <string>

#include "calibrate/base/text.h"
#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/store/program.h"
#include "core/laws/constants.h"
#include "core/laws/epa.h"
#include "core/step/time_step.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

constexpr double kRelaxDrag = 40;  // [1/s], as in our own relaxation of the fill
constexpr double kRelaxTime = 0.25;
constexpr double kRestTime = 4.0;
constexpr double kFallTime = 2.0;     // [s] at most
constexpr double kGroundDepth = 0.1;  // [m] below the table, as in our own test
const std::string kRest = R"(
# the heap comes to rest
run          ${first}
fix          over all halt 100 v_speed < 0.0005 error continue message no
run          ${rest}
unfix        over
)";
const std::string kDump = "id type x y z radius modify sort id format float %.9g\n";

std::string header(const ExportScene& scene, const std::vector<std::string>& notes) {
  std::string out = deck_comment(scene.title) + "# written by " + program_identity() + " from a material card\n";
  if (!notes.empty()) out += "#\n# What is lost or changed:\n";
  for (const auto& note : notes) out += deck_comment("- " + note);
  return out +
         "#\n#   lmp_pastefit -in DECK                  one core\n#   mpirun -np 2 lmp_pastefit -in DECK     two "
         "ranks\n";
}

/// "fix ..." of a wall, whose law is the variable NAME_law.
std::string wall_fix(const std::string& name) {
  return "fix          " + name + " all wall/pastefit " + name + " ${" + name + "_law}\n";
}

std::string deck_begin(const char* comment) {
  return std::string(comment) + R"(
units        si
atom_style   sphere
boundary     f f f
newton       off
comm_modify  mode single vel yes
)";
}

double grain_mass(const ExportScene& scene, double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * scene.grain_density_kg_m3;
}

std::string drag(const ExportScene& scene) {
  const auto& sizes = scene.sizes.radii_m;
  std::string out = format("fix          drag all viscous %.10g", kRelaxDrag * grain_mass(scene, sizes[0]));
  for (std::size_t i = 1; i < sizes.size(); ++i)
    out += format(" scale %zu %.10g", i + 1, std::pow(sizes[i] / sizes[0], 3));
  return out + "\n";
}

/// Step 2. Turning up takes the way of our own test; then the plate falls by its own weight and that of the heap.
std::string drop_deck(const DropPlate& drop) {
  const double angle = std::asin(drop.lift_height_m / drop.length_m);
  std::string out = "\n# step 2: the plate turns up about its hinge\nvariable     start equal $(time)\n";
  out += format("variable     share equal (time-v_start)/%.17g\n", drop.lift_duration_s);
  out += format("variable     tilt equal %.17g*v_share*v_share*(3-2*v_share)\n", -angle);
  out += format("variable     raise equal floor(%.6g/dt)\nrun          ${raise}\n", drop.lift_duration_s);
  out += format("variable     tilt equal %.17g\n", -angle) + kRest;
  out += "\n# it falls, until it is level\n";
  out += format("fix          plate all hinge/pastefit table mass_kg %.17g inertia_kg_m2 %.17g arm_m %.17g &\n",
                drop.mass_kg, drop.mass_kg * drop.length_m * drop.length_m / 3, 0.5 * drop.length_m);
  out += format("             x_m %.17g z_m 0 angle_rad %.17g\n", -0.5 * drop.length_m, -angle);
  out += "variable     tilt equal f_plate\nfix          level all halt 1 v_tilt >= 0 error continue message no\n";
  out += format("variable     fall equal ceil(%.6g/dt)\nrun          ${fall}\n", kFallTime);
  out += "unfix        level\nvariable     tilt equal 0\nunfix        plate\n" + kRest;
  return out + "write_dump   all custom heap2.dump " + kDump;
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

std::string material_file(const ExportScene& scene, const LammpsLaws& laws) {
  std::string out = deck_comment(scene.title) + "# written by " + program_identity() + " from a material card\n";
  out += "#\n# Names and numbers of the laws are those of the card; style/README.md explains them.\n#\n";
  out += "# Include it where the grains are there (read_data, create_box), in a script with:\n";
  out += "#   units si, atom_style sphere, newton off, comm_modify mode single vel yes\n";
  out += "#   density of a grain " + grain_density_in_words(scene) +
         format(",\n#   mean radius %.9g m, time steps of %.6g s at most\n", scene.radius_m(), deck_time_step_s(scene));
  for (const auto& wall : laws.walls) out += "#   " + wall_fix(wall.name);
  out += "\n" + laws.guard + laws.pairs;
  for (const auto& wall : laws.walls) out += "variable     " + wall.name + "_law string \"" + wall.law + "\"\n";
  return out;
}

std::string slump_deck(const ExportScene& scene, const LammpsLaws& laws, const std::vector<std::string>& notes) {
  const SlumpTest& test = *scene.slump();
  const auto& mould = test.mould;
  std::string out = header(scene, notes) + deck_begin("\n# the scene");
  out += "processors   * * 1\nread_data    grains.data\ninclude      material.inc\n";
  out += format("neighbor     %.6g bin\nneigh_modify delay 0 every 1 check yes\ntimestep     %.6g\n",
                0.15 * scene.sizes.radii_m[0], deck_time_step_s(scene));
  out += format("fix          weight all gravity %.6g vector 0 0 -1\nfix          motion all nve/sphere\n", kGravity);
  const double half = 0.5 * (test.drop ? test.drop->length_m : test.table_length_m);
  const bool falls = test.drop && test.drop->motion == TableMotion::hinged;
  if (falls) out += "variable     tilt equal 0\n";
  out += format("region       table block %.17g %.17g %.17g %.17g %.17g 0 side out", -half, half, -half, half,
                -0.5 * kGroundDepth);
  out += falls ? format(" rotate v_tilt %.17g 0 0 0 1 0\n", -half) : "\n";
  out += format("region       ground plane 0 0 %.17g 0 0 1\n", -kGroundDepth);
  out += "variable     rise equal 0\n";
  out += format("region       mould cone z 0 0 %.17g %.17g 0 %.17g open 1 open 2 move NULL NULL v_rise\n",
                mould.base_radius_m, mould.top_radius_m, mould.height_m);
  for (const auto& wall : laws.walls) out += wall_fix(wall.name);
  out += "compute      top all reduce max z\n";
  out += "variable     speed equal sqrt(2*ke/mass(all))   # root mean square [m/s]\n";
  out += "thermo_style custom step time atoms ke c_top v_speed\nthermo       1000\n";
  out += "thermo_modify norm no lost error\n\n";

  out += "# the fill feels its attraction: relax in the mould, with drag\n";
  out += drag(scene);
  out += format("variable     relax equal ceil(%.6g/dt)\nrun          ${relax}\n", kRelaxTime);
  out += "unfix        drag\nwrite_dump   all custom filled.dump " + kDump;

  out += "\n# step 1: the mould rises at constant speed until it is above the heap\n";
  out += "variable     start equal $(time)\n";
  out += format("variable     rise equal %.17g*(time-v_start)\n", test.lift_velocity_m_s);
  out += "variable     below equal c_top-v_rise\n";
  out += "fix          over all halt 100 v_below < 0 error continue message no\n";
  out += format("variable     lift equal ceil(%.6g/dt)\nrun          ${lift}\n",
                1.2 * mould.height_m / test.lift_velocity_m_s);
  out += "unfix        over\nunfix        mould\nregion       mould delete\n";

  out += format("variable     rest equal ceil(%.6g/dt)\nvariable     first equal ceil(0.2/dt)\n", kRestTime);
  out += kRest;
  out += "write_dump   all custom heap.dump " + kDump;
  if (falls) out += drop_deck(*test.drop);
  out += "run          0 post no\nprint        \"highest grain centre $(c_top) m\"\n";
  return out;
}

std::vector<std::string> lammps_dumps(const ExportScene& scene) {
  if (!scene.slump()) return {};
  std::vector<std::string> names{"filled.dump", "heap.dump"};
  if (scene.slump()->drop) names.push_back("heap2.dump");
  return names;
}

std::string two_grains_deck(const ExportScene& scene, const std::vector<std::string>& notes) {
  const double radius = scene.sizes.radii_m[0];
  const auto legs = two_grain_legs(scene.contact(), radius);
  std::string out = header(scene, notes);
  out += deck_begin(
      "\n# force of two grains against their distance; prints \"apart r F\", then \"back r F\"; of a law\n"
      "# with a memory of the overlap \"path r F\"");
  out += format("region       box block %.6g %.6g %.6g %.6g %.6g %.6g\n", -4 * radius, 8 * radius, -4 * radius,
                4 * radius, -4 * radius, 4 * radius);
  out += format("create_box   %zu box\ncreate_atoms 1 single 0 0 0\n", scene.sizes.radii_m.size());
  out += format("create_atoms 1 single %.17g 0 0\n", legs[0].from_m);
  out += format("set          type 1 diameter %.17g\nset          type 1 density %.17g\n", 2 * radius,
                scene.grain_density_kg_m3);
  out += "include      material.inc\n";
  out += format("neighbor     %.6g bin\nneigh_modify delay 0 every 1 check yes\n", 0.15 * radius);
  out += "fix          motion all nve/sphere\n";
  out += "group        second id 2\ncompute      push second reduce sum fx\ncompute      at second reduce sum x\n";
  out += "thermo_style custom step c_push c_at\n";
  out += "variable     push equal c_push\nvariable     at equal c_at\n";
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Leg& leg = legs[i];
    out += format("variable     n loop %d\nlabel        next_%zu\nrun          0 post no\n", leg.steps, i + 1);
    out += format("print        \"%s $(v_at:%%.17g) $(v_push:%%.17g)\"\n", leg.word);
    out += format("displace_atoms second move %.17g 0 0 units box\n", (leg.to_m - leg.from_m) / leg.steps);
    out += format("next         n\njump         SELF next_%zu\n", i + 1);
  }
  return out;
}

std::vector<ExportWall> walls_in_deck(const ExportScene& scene) {
  auto walls = walls_of(scene.test);
  if (!scene.slump()) return walls;
  walls.push_back({"ground", scene.slump()->table_wall});
  walls.back().contact.rolling_friction = 1;  // as in our own test
  return walls;
}

std::vector<ExportFile> lammps_deck(const ExportScene& scene, const LammpsLaws& laws,
                                    const std::vector<std::string>& notes, std::span<const double> radii) {
  const ExportFile material{"material.inc", material_file(scene, laws)};
  if (!scene.slump()) return {{"in.two_grains", two_grains_deck(scene, notes)}, material};
  return {{kLammpsDeck, slump_deck(scene, laws, notes)},
          {"in.two_grains", two_grains_deck(scene, {})},
          material,
          {"grains.data", grains_data(scene, radii)}};
}

std::string grains_data(const ExportScene& scene, std::span<const double> radii) {
  const SlumpTest& test = *scene.slump();
  const auto& grains = scene.packing.centres;
  const double margin = 4 * std::ranges::max(radii);
  const double half = std::max(test.table_length_m, 4 * test.mould.height_m) + margin;
  std::string out = "grains of a filled mould, written by pastefit\n\n";
  out += format("%zu atoms\n%zu atom types\n\n", grains.size(), scene.sizes.radii_m.size());
  out += format("%.9g %.9g xlo xhi\n%.9g %.9g ylo yhi\n%.9g %.9g zlo zhi\n\n", -half, half, -half, half,
                -kGroundDepth - margin, 2 * test.mould.height_m + margin);
  out += "Atoms # sphere\n\n";
  for (std::size_t i = 0; i < grains.size(); ++i)
    out += format("%zu %d %.17g %.17g %.17g %.17g %.17g\n", i + 1, scene.sizes.class_of[i] + 1, 2 * radii[i],
                  scene.grain_density_kg_m3, grains[i].x, grains[i].y, grains[i].z);
  return out;
}

namespace {

/// The words of a line, numbers as in C whatever the locale.
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
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    double seconds = 0, percent = 0;
    int ranks = 0;
    if (line.starts_with("LAMMPS (")) {
      if (log.copies++ == 0) log.program = line;
    } else if (line.starts_with("ERROR")) {
      if (log.error.empty()) log.error = line;
    } else if (is_loop(line, seconds, ranks)) {
      end_of_loop();
      loop_s = std::max(0.0, seconds);
      log.ranks = std::max(log.ranks, ranks);
    } else if (is_share(line, percent)) {
      share = percent / 100;
    } else if (line.starts_with("Total wall time:")) {
      log.ended = true;
    }
  }
  end_of_loop();
  return log;
}

}  // namespace pastefit
