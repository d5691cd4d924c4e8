#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

#include "calibrate/exports/elasto_plastic.h"
#include "calibrate/exports/export.h"
#include "core/laws/constants.h"
#include "tests/calibrate/exports/scenes.h"

using namespace pastefit;
using namespace pastefit::export_scenes;

namespace {

ExportScene plastic(NormalLaw law, FrictionBasis basis = FrictionBasis::total) {
  SlumpTest test = slump_of_paste();
  test.contact.normal = law;
  test.contact.bridge = {};
  test.contact.plasticity_ratio = 0.85;
  test.contact.adhesion_ratio = 1.5;
  test.contact.cohesion_n = 0.01;
  test.contact.friction_basis = basis;
  test.table_wall.cohesion_factor = 0.5;
  return scene(test);
}

std::string file_of(const Export& written, const std::string& name) {
  for (const auto& file : written.files)
    if (file.name == name) return file.content;
  return {};
}

/// The numbers after a property's name and style.
std::vector<double> property_of(const std::string& material, const std::string& name, int words) {
  std::istringstream rest(material.substr(material.find(" " + name + " ") + name.size() + 2));
  std::string word;
  for (int i = 0; i < words; ++i) rest >> word;
  std::vector<double> out;
  std::string line;
  std::getline(rest, line);
  std::istringstream numbers(line);
  for (double value = 0; numbers >> value;) out.push_back(value);
  return out;
}

}  // namespace

TEST_CASE("a card of linear springs goes to LIGGGHTS as its edinburgh model with the same k1, k2, kc and f0") {
  const auto card = plastic(NormalLaw::luding);
  const auto written = export_liggghts(card);
  REQUIRE(written.ok());
  CHECK(written.value().own_law.empty());
  const std::string material = file_of(written.value(), "material.inc"), deck = file_of(written.value(), "in.slump");
  CHECK_THAT(material, Catch::Contains("pair_style   gran model edinburgh tangential tan_luding") &&
                           Catch::Contains("fixKc on limitForce off") && Catch::Contains("map array sort 0 0"));
  // Without the first pulls are cut to zero, without the second contacts forget, and a wall takes settings at its end.
  CHECK_THAT(deck,
             Catch::Contains("zplane 0.0 ${wall_settings}\n") && Catch::Contains("atom_modify map array sort 0 0"));
  CHECK_THAT(deck, !Catch::Contains("mpirun") && !Catch::Contains("elastic springs first"));
  // LIGGGHTS takes k1 = 2 E* R* where the card has 4/3 E* R*.
  CHECK(property_of(material, "youngsModulus", 1)[0] == Approx(2.0 / 3 * card.contact().youngs_modulus_pa));
  CHECK(property_of(material, "UnloadingStiffness", 2)[0] == Approx(1 / 0.15));
  const auto adhesion = property_of(material, "coefficientAdhesionStiffness", 2);
  REQUIRE(adhesion.size() == 9);
  CHECK(adhesion[0] == 1.5);
  CHECK(adhesion[1] == 0);             // the mould
  CHECK(adhesion[2] == Approx(0.75));  // half of it on the table
  const auto pull = property_of(material, "pullOffForce", 2);
  CHECK(pull[0] == Approx(-0.01));
  CHECK(pull[2] == Approx(-0.005));
}

TEST_CASE(
    "LIGGGHTS's tangential spring is the card's: of epa at every overlap, of luding at a ninth of the matched one") {
  for (const auto law : {NormalLaw::epa, NormalLaw::luding}) {
    const auto card = plastic(law);
    const Edinburgh edinburgh(card);
    const std::string material = file_of(export_liggghts(card).value(), "material.inc");
    const PairConstants pair = grain_pair(card.contact(), card.radius_m());
    const double effective = 0.5 * card.radius_m(), overlap = edinburgh.overlap_ratio * effective / 9;
    const double card_stiffness = pair.tangential_ratio * pair.normal_stiffness *
                                  (law == NormalLaw::luding ? 2.0 / 3 * effective : std::sqrt(effective * overlap));
    const double deck_stiffness = property_of(material, "coeffFrictionStiffness", 2)[0] * pair.normal_stiffness *
                                  edinburgh.modulus_share * std::sqrt(effective * overlap);
    CHECK(deck_stiffness == Approx(card_stiffness).epsilon(1e-9));
  }
}

TEST_CASE("friction of the net force goes to LIGGGHTS as its own, of the total force as Luding's") {
  const auto words = [](FrictionBasis basis) {
    return file_of(export_liggghts(plastic(NormalLaw::luding, basis)).value(), "material.inc");
  };
  CHECK_THAT(words(FrictionBasis::net), Catch::Contains("tangential history rolling_friction epsd"));
  CHECK_THAT(words(FrictionBasis::total), Catch::Contains("tangential tan_luding rolling_friction luding"));
  CHECK_THAT(words(FrictionBasis::elastic), Catch::Contains("tangential tan_luding rolling_friction luding"));
}

TEST_CASE("LIGGGHTS's restitution makes its dashpot the card's") {
  const auto card = plastic(NormalLaw::luding);
  const Edinburgh edinburgh(card);
  for (const double restitution : {0.2, 0.5, 0.9})
    CHECK(damping_ratio(edinburgh.restitution(restitution)) ==
          Approx(std::sqrt(5.0 / 6) * damping_ratio(restitution)).epsilon(1e-9));
  CHECK(edinburgh.restitution(1) == 1);
  CHECK(edinburgh.restitution(1e-3) > 0.05);
}

TEST_CASE("the surface energy given for EEPA pulls two pressed grains apart by the card's force") {
  const auto card = plastic(NormalLaw::epa);
  const double effective = 0.5 * card.radius_m(), depth = matched_overlap_ratio(card) * effective;
  const double k1 = grain_pair(card.contact(), card.radius_m()).hertz * std::sqrt(effective);
  // The unloading line k2 (d^m - p^m) meets the adhesion branch -kc d^m.
  const double k2 = k1 / 0.15, kc = 1.5 * k1, plastic_power = 0.85 * std::pow(depth, 1.5);
  const double met = k2 * plastic_power / (k2 + kc);
  const double patch = std::sqrt(2 * effective * std::pow(plastic_power, 2.0 / 3));
  CHECK(1.5 * std::numbers::pi * eepa_surface_energy(card) * patch == Approx(kc * met).epsilon(1e-9));
  const auto written = export_edem_notes(card);
  REQUIRE(written.ok());
  char text[80];
  std::snprintf(text, sizeof text, "surface energy %.6g J/m2, contact plasticity ratio 0.85",
                eepa_surface_energy(card));
  CHECK_THAT(text_of(written.value()), Catch::Contains(text));
}

TEST_CASE("the way of two elasto-plastic grains goes through all branches and never rests at touch") {
  for (const auto law : {NormalLaw::epa, NormalLaw::luding}) {
    const auto card = plastic(law);
    const auto legs = two_grain_legs(card.contact(), kRadius);
    REQUIRE(legs.size() == 9);
    for (std::size_t i = 0; i < legs.size(); ++i) {
      CHECK(std::string(legs[i].word) == "path");
      CHECK(std::fabs(legs[i].to_m - legs[i].from_m) / legs[i].steps == Approx(0.001 * kRadius));
      if (i > 0) CHECK(legs[i].from_m == legs[i - 1].to_m);
    }
    CHECK_THAT(file_of(export_lammps(card).value(), "in.two_grains"), Catch::Contains("print        \"path "));
    CHECK_THAT(file_of(export_liggghts(card).value(), "in.two_grains"), Catch::Contains("\"path ${at} ${push}\""));
  }
}

TEST_CASE("decks resolve the stiffer spring of elasto-plastic grains") {
  auto soft = plastic(NormalLaw::epa), stiff = plastic(NormalLaw::epa);
  specimen_of(stiff.test).contact.plasticity_ratio = 0.96;
  const auto step_of = [](const ExportScene& one) {
    const std::string deck = file_of(export_lammps(one).value(), "in.slump");
    return std::stod(deck.substr(deck.find("timestep ") + 9));
  };
  CHECK(step_of(stiff) / step_of(soft) == Approx(std::sqrt(0.04 / 0.15)).epsilon(0.1));
}
