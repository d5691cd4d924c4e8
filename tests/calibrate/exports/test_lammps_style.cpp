#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "calibrate/exports/export.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/target_laws.h"
#include "core/laws/contact.h"
#include "data/lammps/surfaces.h"
#include "tests/calibrate/exports/scenes.h"

// The style for LAMMPS (data/lammps) takes the engine's laws; here it chooses among them and reads its words.

using namespace pastefit;
using namespace pastefit::export_scenes;
namespace style = pastefit_lammps;

namespace {

constexpr double kStep = 1e-5;
const WallContact kWall{1e8, 0.2, 0.5, 0.4, 0.3, 0.7};

ContactModel paste(NormalLaw normal, BridgeShape shape, RollingModel rolling) {
  ContactModel model;
  model.normal = normal;
  model.rolling = rolling;
  model.cohesion_n = 0.2;
  model.surface_energy_j_m2 = 3;
  model.cohesion_energy_density_pa = 40'000;
  model.plasticity_ratio = 0.8;
  model.adhesion_ratio = 1.5;
  model.bridge = {shape, BridgeFormation::film, -1500, 40, 0.3, -0.004, 0.0012, 1e-9, 3, 0.2, 0.3};
  return model;
}

/// A pair that comes together, is pressed, sheared, rolled and twisted, and is torn apart beyond rupture.
struct PairMotion {
  double time = 0;

  double overlap() const { return 2e-4 - 6e-3 * std::cos(40 * time) * std::cos(40 * time); }
  Vec3 normal() const {
    return {std::cos(0.3 * time) * std::cos(2 * time), std::cos(0.3 * time) * std::sin(2 * time), std::sin(0.3 * time)};
  }
  Vec3 velocity() const { return {0.3 * std::sin(50 * time), 0.2, -0.4 * std::cos(70 * time)}; }
  Vec3 spin() const { return {3 * std::cos(60 * time), 20 * std::sin(30 * time), -5}; }
  style::Meeting meeting(double small, double large) const {
    return {normal(), overlap(), velocity(), spin(), 7.0, small * large / (small + large), 0.003, small};
  }
};

/// Steps of the motion at which force, moment or memory are not the engine's to the last bit; and those with a force.
template <class Normal, class Attraction, class Rolling, bool viscous>
std::pair<int, int> different_steps(const PairConstants& pair, const style::Surfaces& surfaces) {
  constexpr double small = 0.006, large = 0.010;
  ContactHistory<double> history{};
  style::History other{};
  int different = 0, acting = 0;
  for (PairMotion motion; motion.time < 0.1; motion.time += kStep) {
    const style::Meeting m = motion.meeting(small, large);
    const ContactKinematics<double> kinematics{
        m.normal,         m.overlap,           m.velocity,        m.spin,     m.twist,
        m.smaller_radius, std::sqrt(m.radius), std::sqrt(m.mass), 1 / m.mass, 0.0};
    // Beyond its reach a pair is not asked of.
    if (m.overlap < -pair.formation_gap * pair.size_per_radius * m.radius && style::is_empty(history)) {
      different += norm(surfaces.act(m, other, kStep, false).moment) > 0 || !style::is_empty(other);
      continue;
    }
    const auto ours = act<Normal, Attraction, Rolling, viscous>(pair, kinematics, history, kStep, Energies::none);
    const Vec3 force = ours.tangential_force - ours.normal_force * m.normal;
    const style::Reaction theirs = surfaces.act(m, other, kStep, false);
    acting += norm(force) > 0;
    const double off = norm(force - theirs.force) + norm(ours.moment - theirs.moment) +
                       norm(history.slip - other.slip) + std::fabs(history.bond - other.bond);
    different += off != 0;
  }
  return {different, acting};
}

template <class Visit>
void each_combination(const Visit& visit) {
  for (const auto& [normal_word, normal] : normal_laws)
    for (const auto& [shape_word, shape] : bridge_shapes)
      for (const auto& [rolling_word, rolling] : rolling_models) {
        if (!go_together(normal, shape)) continue;
        INFO(normal_word << ", " << shape_word << ", " << rolling_word);
        visit(paste(normal, shape, rolling));
      }
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> out;
  std::string word;
  for (const char c : text + " ") {
    if (c != ' ' && c != '&') word += c;
    if (c == ' ' && !word.empty()) out.push_back(std::exchange(word, ""));
  }
  return out;
}

std::string between(const std::string& whole, const std::string& command, const std::string& end) {
  const auto from = whole.find(command) + command.size();
  std::string text = whole.substr(from, whole.find(end, from) - from);
  std::ranges::replace(text, '\n', ' ');
  return text;
}

const std::string kPlain =
    "reference_radius_m 0.008 youngs_modulus_pa 2e6 poissons_ratio 0.3 restitution 0.3 friction 0.5 rolling_friction "
    "0.1 rolling none friction_basis total cohesion_n 0.2";

}  // namespace

TEST_CASE("LAMMPS runs every law that the engine has, and every law that a study can start from") {
  each_combination([](const ContactModel& model) {
    ExportScene one = scene(slump_of_paste());
    specimen_of(one.test).contact = model;
    CHECK(export_lammps(one).ok());
  });
  for (const TargetLaws& laws : target_laws()) {
    INFO(laws.law);
    CHECK(laws_for("lammps", laws.law));
  }
}

TEST_CASE(
    "the style for LAMMPS acts as the engine to the last bit, of every combination of laws, on grains and walls") {
  each_combination([](ContactModel model) {
    for (const auto basis : {FrictionBasis::elastic, FrictionBasis::total, FrictionBasis::net}) {
      model.friction_basis = basis;
      const auto compare = [&](const PairConstants& pair, const style::Surfaces& surfaces) {
        with_law(NormalLaws{}, model.normal, [&](auto normal) {
          with_law(Attractions{}, model.bridge.shape, [&](auto attraction) {
            with_law(RollingLaws{}, model.rolling, [&](auto rolling) {
              using Normal = decltype(normal);
              using Attraction = decltype(attraction);
              using Rolling = decltype(rolling);
              if constexpr (go_together(Normal{}, Attraction{})) {
                const auto [different, acting] =
                    different_steps<Normal, Attraction, Rolling, Attraction::present>(pair, surfaces);
                CHECK(different == 0);
                CHECK(acting > 100);
              }
            });
          });
        });
      };
      compare(grain_pair(model, kRadius), style::Surfaces({kRadius, model}));
      compare(wall_pair(model, kWall, kRadius), style::Surfaces({kRadius, model}, kWall));
    }
  });
}

TEST_CASE("where time stands still the style's springs stay as they were") {
  const style::Surfaces surfaces(
      {kRadius, paste(NormalLaw::hertz, BridgeShape::polynomial, RollingModel::spring_dashpot)});
  style::History history{};
  // Too slow to slide.
  const style::Meeting meeting{{1, 0, 0}, 1e-4, {0, 1e-3, 0}, {0, 0, 0.02}, 0.5, 0.004, 0.003, kRadius};
  for (int step = 0; step < 20; ++step) surfaces.act(meeting, history, kStep, false);
  const style::History before = history;
  REQUIRE(norm(before.slip) > 1e-7);
  REQUIRE(norm(before.roll) > 1e-6);
  surfaces.act(meeting, history, kStep, true);
  CHECK(norm(history.slip - before.slip) < 1e-12 * norm(before.slip));
  CHECK(norm(history.roll - before.roll) < 1e-12 * norm(before.roll));
  surfaces.act(meeting, history, kStep, false);
  CHECK(norm(history.slip) > 1.04 * norm(before.slip));
}

TEST_CASE("the style for LAMMPS reaches as far as a bridge, or a contact that is torn apart, of any size") {
  const auto reach = [](NormalLaw normal, BridgeShape shape, double radius) {
    return style::Surfaces({kRadius, paste(normal, shape, RollingModel::none)}).reach(radius);
  };
  CHECK(reach(NormalLaw::hertz, BridgeShape::none, 0.5 * kRadius) == 0);
  CHECK(reach(NormalLaw::hertz, BridgeShape::linear, 0.5 * kRadius) == Approx(0.004));
  CHECK(reach(NormalLaw::hertz, BridgeShape::linear, kRadius) == Approx(0.008));
  const double torn = grain_pair(paste(NormalLaw::jkr, BridgeShape::none, RollingModel::none), kRadius).pull_off_gap;
  CHECK(reach(NormalLaw::jkr, BridgeShape::none, 0.5 * kRadius) == Approx(torn));
  CHECK(reach(NormalLaw::jkr, BridgeShape::none, kRadius) >= std::cbrt(2) * torn);
}

TEST_CASE("the style for LAMMPS names every fault of its words") {
  style::Law law;
  CHECK(style::read_law(words(kPlain), law).empty());
  CHECK(law.grains.bridge.shape == BridgeShape::none);
  const std::string faults = style::read_law(
      words("reference_radius_m 0 youngs_modulus_pa 2e6x poissons_ratio 0.6 restitution 0.3 friction 0.5 fricton 0.1 "
            "rolling some friction_basis total cohesion_n 0.2 bridge.shape polynomial bridge.c_n 1 bridge.d_c_m 0.004"),
      law);
  for (const char* fault :
       {"'reference_radius_m 0' is not in its range", "'youngs_modulus_pa 2e6x'", "'poissons_ratio' is to be",
        "'rolling_friction' is missing", "'rolling some': one of none", "'bridge.d_c_m', an overlap",
        "'bridge.formation' is missing", "'fricton' is not known here"})
    CHECK_THAT(faults, Catch::Contains(fault));
}

TEST_CASE("the style for LAMMPS takes laws together that go together only") {
  const std::string bridge =
      " bridge.shape linear bridge.formation touch bridge.a_n_m2 0 bridge.b_n_m 0 bridge.c_n 1 bridge.d_c_m -0.004 "
      "bridge.offset_m 0 bridge.liquid_volume_m3 0 bridge.surface_tension_n_m 0 bridge.contact_angle_rad 0";
  const auto faults = [](const std::string& text) {
    style::Law law;
    return style::read_law(words(text), law);
  };
  CHECK(faults(kPlain + " normal epa plasticity_ratio 0.85 adhesion_ratio 1") == "");
  CHECK(faults(kPlain + " normal jkr surface_energy_j_m2 3" + bridge) == "");
  CHECK_THAT(faults(kPlain + " normal epa plasticity_ratio 1"), Catch::Contains("'plasticity_ratio' is to be"));
  CHECK_THAT(faults(kPlain + " normal luding" + bridge), Catch::Contains("goes beside no bridge"));
}

TEST_CASE("the deck for LAMMPS speaks the words of the style that goes with it") {
  each_combination([](const ContactModel& model) {
    SlumpTest test = slump_of_paste();
    test.contact = model;
    test.drop = DropPlate{};
    const auto written = export_lammps(scene(test));
    REQUIRE(written.ok());
    const auto file = [&](std::string_view name) {
      return std::ranges::find(written.value().files, name, &ExportFile::name)->content;
    };
    const std::string deck = file("in.slump"), material = file("material.inc");
    style::Law law;
    CHECK(style::read_law(words(between(material, "pair_style   pastefit ", "\npair_coeff")), law) == "");
    CHECK(law.reference_radius_m == test.grains.radius_m);
    // What was read acts as the card's.
    const PairConstants own = grain_pair(model, kRadius), read = grain_pair(law.grains, kRadius);
    CHECK(std::pair(read.hertz, read.cohesion) == std::pair(own.hertz, own.cohesion));
    CHECK(std::pair(read.adhesion, read.stiffening) == std::pair(own.adhesion, own.stiffening));
    CHECK(std::pair(read.bridge_c, read.rupture_gap) == std::pair(own.bridge_c, own.rupture_gap));
    CHECK(std::pair(read.formation_gap, read.viscosity) == std::pair(own.formation_gap, own.viscosity));
    CHECK(law.grains.rolling == model.rolling);
    WallContact wall;
    CHECK(style::read_wall(words(between(material, "mould_law string \"", "\"")), wall) == "");
    CHECK(wall.friction == test.mould_wall.friction);
    CHECK_THAT(deck, Catch::Contains("\ninclude      material.inc\n") &&
                         Catch::Contains("wall/pastefit mould ${mould_law}\n") && !Catch::Contains("\npair_style"));
    style::Hinge plate;
    CHECK(style::read_hinge(words(between(deck, "hinge/pastefit table ", "\nvariable")), plate) == "");
    CHECK(plate.angle_rad == Approx(-std::asin(0.04 / 0.7)));
  });
}

TEST_CASE("the style for LAMMPS comes with the engine's laws as they are") {
  const auto written = export_lammps(scene(slump_of_paste()));
  REQUIRE(written.ok());
  const auto& files = written.value().files;
  for (const char* name : {"style/surfaces.cpp", "style/core/laws/jkr.h", "style/core/laws/constants.cpp",
                           "style/core/vec3.h", "style/calibrate/laboratory/names.h"}) {
    INFO(name);
    REQUIRE(std::ranges::count(files, name, &ExportFile::name) == 1);
  }
  std::ifstream own(PASTEFIT_SOURCE_DIR "/core/laws/jkr.h");
  CHECK(std::ranges::find(files, "style/core/laws/jkr.h", &ExportFile::name)->content ==
        std::string(std::istreambuf_iterator<char>(own), {}));
}
