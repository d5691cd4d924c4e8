#include <catch2/catch.hpp>
#include <cmath>

#include "calibrate/exports/export.h"
#include "calibrate/laboratory/names.h"
#include "core/laws/contact.h"
#include "data/lammps/contact_law.h"

// The contact law is written a second time for LAMMPS (data/lammps); here both act on the same motions.

using namespace pastefit;
namespace style = pastefit_lammps;

namespace {

constexpr double kGrainRadius = 0.008, kStep = 1e-5;

ContactModel paste(BridgeShape shape) {
  ContactModel model;
  model.cohesion_n = 0.2;
  model.bridge = {shape, BridgeFormation::film, -1500, 40, 0.3, -0.004, 0.0012, 1e-9, 3, 0.2, 0.3};
  return model;
}

style::Law law_of(const ContactModel& model) {
  const auto word = [](auto value, const auto& words) {
    for (const auto& one : words)
      if (one.value == value) return std::string(one.name);
    return std::string();
  };
  const Bridge& bridge = model.bridge;
  return {kGrainRadius,
          model.youngs_modulus_pa,
          model.poissons_ratio,
          model.restitution,
          model.friction,
          model.rolling_friction,
          word(model.rolling, rolling_models),
          word(model.friction_basis, friction_bases),
          *model.cohesion_n,
          word(bridge.shape, bridge_shapes),
          word(bridge.formation, bridge_formations),
          bridge.a_n_m2,
          bridge.b_n_m,
          bridge.c_n,
          bridge.d_c_m,
          bridge.offset_m,
          bridge.liquid_volume_m3,
          bridge.surface_tension_n_m,
          bridge.contact_angle_rad,
          bridge.viscosity_pa_s,
          word(model.normal, normal_laws),
          model.plasticity_ratio,
          model.adhesion_ratio};
}

/// A pair that comes together, is pressed, sheared, rolled and twisted, and is torn apart beyond rupture.
struct Motion {
  double time = 0;

  double overlap() const { return 2e-4 - 6e-3 * std::cos(40 * time) * std::cos(40 * time); }
  style::Vector normal() const {
    return {std::cos(0.3 * time) * std::cos(2 * time), std::cos(0.3 * time) * std::sin(2 * time), std::sin(0.3 * time)};
  }
  style::Vector velocity() const { return {0.3 * std::sin(50 * time), 0.2, -0.4 * std::cos(70 * time)}; }
  style::Vector spin() const { return {3 * std::cos(60 * time), 20 * std::sin(30 * time), -5}; }
};

Vec3 of(const style::Vector& v) {
  return {v.x, v.y, v.z};
}

/// Largest difference of a force, and of a moment over the radius, in units of the largest force [1].
template <class Attraction, class Rolling, class Normal = Hertz>
double difference(const PairConstants& pair, const style::Contact& contact, double small, double large) {
  const double radius = small * large / (small + large), mass = 0.003;
  ContactHistory<double> history{};
  style::ContactHistory other{};
  double largest = 0, worst = 0;
  for (Motion motion; motion.time < 0.1; motion.time += kStep) {
    const ContactKinematics<double> kinematics{
        of(motion.normal()),    motion.overlap(),  of(motion.velocity()), of(motion.spin()), 7.0,
        std::min(small, large), std::sqrt(radius), std::sqrt(mass),       1 / mass,          0.0};
    const auto contact_force =
        act<Normal, Attraction, Rolling, Attraction::present>(pair, kinematics, history, kStep, Energies::none);
    const Vec3 force = contact_force.tangential_force - contact_force.normal_force * kinematics.normal;
    const auto theirs = contact.act({motion.normal(), motion.overlap(), motion.velocity(), motion.spin(), 7.0, radius,
                                     mass, std::min(small, large)},
                                    other, kStep, kStep);
    largest = std::max(largest, norm(force));
    worst = std::max(
        {worst, norm(force - of(theirs.force)), norm(contact_force.moment - of(theirs.moment)) / kGrainRadius});
    CHECK(history.bond == Approx(other.bridge).epsilon(1e-9).margin(1e-12));
  }
  return worst / largest;
}

template <class Attraction>
void compare(BridgeShape shape) {
  for (const auto basis : {FrictionBasis::elastic, FrictionBasis::total}) {
    ContactModel model = paste(shape);
    model.friction_basis = basis;
    const auto of_law = [&](RollingModel rolling, const auto& check) {
      model.rolling = rolling;
      const WallContact wall{1e8, 0.2, 0.5, 0.4, 0.3, 0.7};
      const style::WallLaw same{1e8, 0.2, 0.5, 0.4, 0.3, 0.7};
      check(grain_pair(model, kGrainRadius), style::Contact(law_of(model)));
      check(wall_pair(model, wall, kGrainRadius), style::Contact(law_of(model), same));
    };
    of_law(RollingModel::none, [](const auto& pair, const auto& contact) {
      CHECK(difference<Attraction, NoRolling>(pair, contact, 0.006, 0.010) < 1e-6);
    });
    of_law(RollingModel::spring_dashpot, [](const auto& pair, const auto& contact) {
      CHECK(difference<Attraction, SpringDashpotRolling>(pair, contact, 0.006, 0.010) < 1e-6);
    });
    of_law(RollingModel::constant_torque, [](const auto& pair, const auto& contact) {
      CHECK(difference<Attraction, ConstantTorqueRolling>(pair, contact, 0.006, 0.010) < 1e-6);
    });
  }
}

/// Elasto-plastic grains, on grains and walls.
template <class Normal>
void compare_plastic() {
  for (const auto basis : {FrictionBasis::elastic, FrictionBasis::total, FrictionBasis::net})
    for (const double adhesion : {0.0, 1.0, 6.0}) {
      ContactModel model = paste(BridgeShape::none);
      model.normal = Normal::choice;
      model.plasticity_ratio = 0.8;
      model.adhesion_ratio = adhesion;
      model.friction_basis = basis;
      model.rolling = RollingModel::spring_dashpot;
      const WallContact wall{1e8, 0.2, 0.5, 0.4, 0.3, 0.7};
      const style::WallLaw same{1e8, 0.2, 0.5, 0.4, 0.3, 0.7};
      const auto check = [](const PairConstants& pair, const style::Contact& contact) {
        CHECK(difference<NoAttraction, SpringDashpotRolling, Normal>(pair, contact, 0.006, 0.010) < 1e-6);
      };
      check(grain_pair(model, kGrainRadius), style::Contact(law_of(model)));
      check(wall_pair(model, wall, kGrainRadius), style::Contact(law_of(model), same));
    }
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> out;
  std::string word;
  for (const char c : text + " ") {
    if (c != ' ') word += c;
    if (c == ' ' && !word.empty()) out.push_back(std::exchange(word, ""));
  }
  return out;
}

const std::string kPlain =
    "reference_radius_m 0.008 youngs_modulus_pa 2e6 poissons_ratio 0.3 restitution 0.3 friction 0.5 rolling_friction "
    "0.1 "
    "rolling none friction_basis total cohesion_n 0.2 bridge none";

}  // namespace

TEST_CASE("the law that is exported to LAMMPS acts as the engine's, bridge after bridge") {
  compare<NoAttraction>(BridgeShape::none);
  compare<PolynomialAttraction>(BridgeShape::polynomial);
  compare<LinearAttraction>(BridgeShape::linear);
  compare<ExponentialAttraction>(BridgeShape::exponential);
  compare<CapillaryAttraction>(BridgeShape::capillary);
}

TEST_CASE("the law that is exported to LAMMPS acts as the engine's for grains that yield and adhere") {
  compare_plastic<Epa>();
  compare_plastic<Luding>();
}

TEST_CASE("the style for LAMMPS names every fault of its words") {
  style::Law law;
  CHECK(style::read_law(words(kPlain), law).empty());
  const std::string faults = style::read_law(
      words("reference_radius_m 0 youngs_modulus_pa 2e6x poissons_ratio 0.3 restitution 0.3 friction 0.5 fricton 0.1 "
            "rolling some friction_basis total cohesion_n 0.2 bridge polynomial c_n 1 d_c_m 0.004 a_n_m2 0 b_n_m 0"),
      law);
  for (const char* fault :
       {"'reference_radius_m 0' is not in its range", "'youngs_modulus_pa 2e6x'", "'rolling_friction' is missing",
        "'rolling some': one of none", "'d_c_m 0.004'", "'formation' is missing", "'fricton' is not known here"})
    CHECK_THAT(faults, Catch::Contains(fault));
}

TEST_CASE("the style for LAMMPS takes elasto-plastic adhesion without a bridge only") {
  style::Law law;
  CHECK(style::read_law(words(kPlain + " normal epa plasticity_ratio 0.85 adhesion_ratio 1"), law).empty());
  CHECK(law.normal == "epa");
  CHECK_THAT(style::read_law(words(kPlain + " normal epa plasticity_ratio 1 adhesion_ratio 1"), law),
             Catch::Contains("'plasticity_ratio 1' is not in its range"));
  CHECK_THAT(style::read_law(words(kPlain + " plasticity_ratio 0.5"), law), Catch::Contains("is not known here"));
  std::string bridged = kPlain;
  bridged.replace(bridged.find("bridge none"), 11, "bridge linear c_n 1 d_c_m -0.004 formation touch");
  CHECK_THAT(style::read_law(words(bridged + " normal luding plasticity_ratio 0.5 adhesion_ratio 1"), law),
             Catch::Contains("needs 'bridge none'"));
}

TEST_CASE("the deck for LAMMPS speaks the words of the style that goes with it") {
  ExportScene scene;
  SlumpTest test;
  test.contact = paste(BridgeShape::polynomial);
  test.drop = DropPlate{};
  scene.packing.centres = {{0, 0, kGrainRadius}};
  scene.packing.radii = {kGrainRadius};
  scene.sizes = size_classes(scene.packing.radii);
  for (const auto shape : {BridgeShape::none, BridgeShape::polynomial, BridgeShape::linear, BridgeShape::exponential,
                           BridgeShape::capillary}) {
    test.contact.bridge.shape = shape;
    scene.test = test;
    const auto written = export_lammps(scene);
    REQUIRE(written.ok());
    const auto file = [&](std::string_view name) {
      return std::ranges::find(written.value().files, name, &ExportFile::name)->content;
    };
    const std::string deck = file("in.slump"), material = file("material.inc");
    const auto between = [](const std::string& whole, const std::string& command, const std::string& end) {
      const auto from = whole.find(command) + command.size();
      std::string text = whole.substr(from, whole.find(end, from) - from);
      std::erase(text, '&');
      std::ranges::replace(text, '\n', ' ');
      return words(text);
    };
    style::Law law;
    CHECK(style::read_law(between(material, "pair_style   pastefit ", "\npair_coeff"), law) == "");
    style::WallLaw wall;
    CHECK(style::read_wall_law(between(material, "mould_law string \"", "\""), wall) == "");
    CHECK(wall.friction == test.mould_wall.friction);
    CHECK_THAT(deck, Catch::Contains("\ninclude      material.inc\n") &&
                         Catch::Contains("wall/pastefit mould ${mould_law}\n") && !Catch::Contains("pair_style"));
    style::Hinge plate;
    CHECK(style::read_hinge(between(deck, "hinge/pastefit table ", "\nvariable"), plate) == "");
    CHECK(plate.angle_rad == Approx(-std::asin(0.04 / 0.7)));
    if (shape == BridgeShape::polynomial) CHECK(law.a_n_m2 == -1500);
  }
}
