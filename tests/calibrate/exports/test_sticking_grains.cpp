#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "calibrate/exports/export.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"
#include "core/laws/attraction.h"
#include "tests/calibrate/exports/scenes.h"

using namespace pastefit;
using namespace pastefit::export_scenes;

TEST_CASE("grains that stick beside a bridge go to LAMMPS, and are refused by each other target, with one fault") {
  SlumpTest material = slump_of_paste();
  material.contact.normal = NormalLaw::jkr;
  material.contact.surface_energy_j_m2 = 5;
  for (const auto& exporter : exporters()) {
    INFO(exporter.name);
    const auto written = exporter.write(scene(material));
    REQUIRE(written.ok() == (exporter.name == "lammps"));
    if (written.ok()) continue;
    REQUIRE(written.faults().size() == 1);
    const bool has_jkr = exporter.name != "csv" && exporter.name != "mercurydpm";
    CHECK(written.faults()[0].where == (has_jkr ? "test.contact.bridge.shape" : "test.contact.normal"));
    CHECK_THAT(written.faults()[0].what, Catch::Contains(has_jkr ? "\"polynomial\"" : "\"jkr\""));
    CHECK_THAT(written.faults()[0].remedy, Catch::Contains(has_jkr ? "attraction \"none\"" : "normal \"hertz\""));
  }
}

TEST_CASE("JKR without a bridge goes to EDEM, which has it, with its surface energy") {
  SlumpTest material = slump_of_paste();
  material.contact.normal = NormalLaw::jkr;
  material.contact.bridge.shape = BridgeShape::none;
  std::vector<double> values = default_values();
  material = std::get<SlumpTest>(with_contact_of(material, values));
  const auto written = export_edem_notes(scene(material));
  REQUIRE(written.ok());
  const auto text = text_of(written.value());
  CHECK_THAT(text, Catch::Contains("surface_energy_j_m2,8,") && Catch::Contains("Hertz-Mindlin with JKR"));
  CHECK_THAT(text, !Catch::Contains("force.csv"));
  CHECK_THAT(text, Catch::Contains("SURFACE_ENERGY = 8  #"));  // of edem_material.py
}

TEST_CASE("a law of grains that stick goes to the targets that have it or one of the same pull-off, and to no others") {
  const std::map<std::string, std::map<std::string_view, std::string>> takers{
      {"jkr",
       {{"lammps", "normal jkr"},
        {"edem-notes", "Hertz-Mindlin with JKR"},
        {"liggghts", "cohesion sjkr2"},
        {"yade", "SURFACE_ENERGY = "}}},
      {"dmt", {{"lammps", "normal dmt"}, {"liggghts", "cohesion sjkr2"}, {"yade", "SURFACE_ENERGY = 8\n"}}},
      {"epa",
       {{"lammps", "normal epa"},
        {"liggghts", "model edinburgh tangential tan_luding"},
        {"mercurydpm", "setPlasticParameters"},
        {"edem-notes", "contact plasticity ratio"},
        {"csv", "plasticity_ratio,"}}},
      {"luding",
       {{"lammps", "normal luding"},
        {"liggghts", "model edinburgh tangential tan_luding"},
        {"mercurydpm", "setPlasticParameters"},
        {"csv", "plasticity_ratio,"}}},
      {"sjkr",
       {{"lammps", "cohesion_energy_density_pa 50000"},
        {"liggghts", "cohesionEnergyDensity peratomtypepair 3 25000 0 0 "},
        {"yade", "SURFACE_ENERGY = "}}}};
  for (const auto& [word, law] : normal_laws) {
    if (law == NormalLaw::hertz) continue;
    SlumpTest material = slump_of_paste();
    material.contact.normal = law;
    material.contact.bridge.shape = BridgeShape::none;
    material = std::get<SlumpTest>(with_contact_of(material, default_values()));
    for (const auto& exporter : exporters()) {
      INFO(exporter.name << ", " << word);
      const auto& having = takers.at(std::string(word));
      const auto written = exporter.write(scene(material));
      const auto taker = having.find(exporter.name);
      REQUIRE(written.ok() == (taker != having.end()));
      if (!written.ok()) {
        REQUIRE(written.faults().size() == 1);
        CHECK(written.faults()[0].where == "test.contact.normal");
        continue;
      }
      const auto text = text_of(written.value());
      CHECK_THAT(text, Catch::Contains(taker->second));
      CHECK_THAT(text, !Catch::Contains("nan") && !Catch::Contains("-inf"));
    }
  }
}

namespace {

SlumpTest sticky() {
  SlumpTest material = slump_of_paste();
  material.contact.normal = NormalLaw::jkr;
  material.contact.bridge.shape = BridgeShape::none;
  return std::get<SlumpTest>(with_contact_of(material, default_values()));
}

/// A pellet crush of granules that stick and roll against a constant torque, as the shipped ones do.
ExportScene pellet() {
  PelletCrush crush;
  crush.grains = {SizeDistribution::normal, 0.00105, 0.000315, 0.00105, 0.0015};
  crush.contact = sticky().contact;
  crush.contact.surface_energy_j_m2 = 3.9;
  crush.contact.rolling = RollingModel::constant_torque;
  crush.contact.rolling_friction = 0.01;
  crush.contact.friction_basis = FrictionBasis::elastic;
  ExportScene out;
  out.title = "Pellet";
  out.test = crush;
  out.grain_density_kg_m3 = 1000;
  out.sizes.radii_m = {crush.grains.radius_m};
  return out;
}

}  // namespace

TEST_CASE("what stands in for JKR parts two mean grains by 3 pi gamma R*, by its closed form") {
  const ContactModel card = sticky().contact;
  const double effective = 0.5 * kRadius, gamma = card.surface_energy_j_m2;
  const double modulus = card.youngs_modulus_pa / (2 * (1 - card.poissons_ratio * card.poissons_ratio));
  const double pull_off = 3 * std::numbers::pi * gamma * effective;
  CHECK(sticking_of(card, effective).pull_off_n == Approx(pull_off).epsilon(1e-12));
  const ContactModel dmt = with_nearest_law(card, NormalLaw::dmt, kRadius);
  CHECK(dmt.surface_energy_j_m2 == Approx(0.75 * gamma).epsilon(1e-12));
  const ContactModel sjkr = with_nearest_law(card, NormalLaw::sjkr, kRadius);
  const double closed =
      std::cbrt(9 * gamma * modulus * modulus / (2 * std::numbers::pi * std::numbers::pi * effective));
  CHECK(sjkr.cohesion_energy_density_pa == Approx(closed).epsilon(1e-12));
  for (const ContactModel& one : {dmt, sjkr})
    CHECK(sticking_of(one, effective).pull_off_n == Approx(pull_off).epsilon(1e-9));
  // Only between mean grains: that of SJKR goes with the square of the size.
  CHECK(sticking_of(sjkr, 2 * effective).pull_off_n == Approx(4 * pull_off).epsilon(1e-9));
  CHECK(sticking_of(dmt, 2 * effective).pull_off_n == Approx(2 * pull_off).epsilon(1e-9));
}

TEST_CASE("what stands in for JKR differs by the same shares for every material, from both laws in closed form") {
  for (const double gamma : {0.4, 8.0}) {
    ContactModel card = sticky().contact;
    card.surface_energy_j_m2 = gamma;
    const double effective = 0.5 * kRadius;
    const auto own = sticking_of(card, effective);
    const auto dmt = sticking_of(with_nearest_law(card, NormalLaw::dmt, kRadius), effective);
    const auto sjkr = sticking_of(with_nearest_law(card, NormalLaw::sjkr, kRadius), effective);
    CHECK(own.at_touch_n == Approx(8.0 / 9 * own.pull_off_n).epsilon(1e-9));
    CHECK(dmt.at_touch_n == Approx(own.pull_off_n).epsilon(1e-9));
    CHECK(sjkr.at_touch_n == 0);
    // d = 2 * 6^(1/3) a_t^2/R* at rest, 3 a_t^2/R* at the end; SJKR (3 pi k/(2 E*))^2 R*, DMT (9 pi gamma/(4 E*))^(2/3)
    // R*^(1/3)
    CHECK(own.part_gap_m / own.resting_overlap_m == Approx(1.5 / std::cbrt(6)).epsilon(1e-9));
    CHECK(sjkr.resting_overlap_m / own.resting_overlap_m == Approx(9.0 / 8 * std::cbrt(54)).epsilon(1e-9));
    CHECK(dmt.resting_overlap_m / own.resting_overlap_m == Approx(0.5 * std::cbrt(13.5)).epsilon(1e-9));
    CHECK(dmt.part_gap_m + sjkr.part_gap_m == 0);
    CHECK(own.load_n == Approx(4 * own.pull_off_n).epsilon(1e-9));
    CHECK(dmt.load_n == Approx(dmt.pull_off_n).epsilon(1e-9));
    CHECK(sjkr.load_n == Approx(6.75 * sjkr.pull_off_n).epsilon(1e-9));
    CHECK(dmt.work_j < own.work_j);
    CHECK(own.work_j < sjkr.work_j);
  }
}

TEST_CASE("where another law stands in for JKR the notes say what differs, with numbers") {
  for (const auto& [write, law] :
       {std::pair{&export_liggghts, NormalLaw::sjkr}, std::pair{&export_yade, NormalLaw::dmt}}) {
    const auto of_pellet = pellet();
    const auto written = write(of_pellet);
    REQUIRE(written.ok());
    const double effective = 0.5 * of_pellet.radius_m();
    const auto own = sticking_of(of_pellet.contact(), effective);
    const auto deck = sticking_of(with_nearest_law(of_pellet.contact(), law, of_pellet.radius_m()), effective);
    const auto text = text_of(written.value());
    const auto said = [&](const char* form, double first, double second) {
      char line[120];
      std::snprintf(line, sizeof line, form, first, second);
      CHECK_THAT(text, Catch::Contains(line));
    };
    said("in the deck, %.3g of their radius; on the card by %.3g mm", deck.resting_overlap_m / of_pellet.radius_m(),
         1e3 * own.resting_overlap_m);
    said("They part at a gap of %.3g mm in the deck, %.3g mm on the card", 0, 1e3 * own.part_gap_m);
    said("costs %.3g J in the deck, %.3g J on the card", deck.work_j, own.work_j);
    said("only stick holds %.3g N in the deck, %.3g N on the card", of_pellet.contact().friction * deck.load_n,
         of_pellet.contact().friction * own.load_n);
    CHECK((text.find("square of the size") != std::string::npos) == (law == NormalLaw::sjkr));
    CHECK_THAT(text, Catch::Contains("overlap_m,card_n,"));
  }
}

TEST_CASE("a card without a slump test goes to DEM programs as its law: two grains, and the walls' laws") {
  const std::map<std::string_view, std::pair<std::string, std::string>> lines{
      {"lammps", {"normal jkr", "tools_law string \"cohesion_factor"}},
      {"liggghts",
       {"pair_style   gran model hertz tangential history cohesion sjkr2 rolling_friction cdt",
        "#   fix tools all wall/gran ${wall_model} mesh"}},
      {"yade", {"SURFACE_ENERGY = ", "WALLS = ['tools', ]"}}};
  for (const auto& exporter : exporters()) {
    INFO(exporter.name);
    const auto written = exporter.write(pellet());
    const auto expected = lines.find(exporter.name);
    if (expected == lines.end()) continue;
    REQUIRE(written.ok());
    CHECK(std::ranges::count_if(written.value().files, [](const auto& file) {
            return file.name.starts_with("in.two_grains") || file.name == "two_grains.py";
          }) == 1);
    const auto text = text_of(written.value());
    CHECK_THAT(text, Catch::Contains(expected->second.first) && Catch::Contains(expected->second.second));
    CHECK_THAT(text, !Catch::Contains("grains.data") && !Catch::Contains("nan") && !Catch::Contains("-inf"));
  }
}

TEST_CASE("in place of a constant torque stands a spring that slips at the same moment after a small turn") {
  const auto stiffness = [](const ExportScene& of) {
    const auto written = export_yade(of);
    REQUIRE(written.ok());
    const auto text = text_of(written.value());
    const auto at = text.find("\nKROT = ");
    REQUIRE(at != std::string::npos);
    return std::pair(text, std::stod(text.substr(text.find('=', at) + 1)));
  };
  const auto [text, torque] = stiffness(pellet());
  CHECK_THAT(text, Catch::Contains("turn by 0.00"));
  auto springs = pellet();
  specimen_of(springs.test).contact.rolling = RollingModel::spring_dashpot;
  const auto [soft, spring] = stiffness(springs);
  CHECK_THAT(soft, !Catch::Contains("turn by"));
  CHECK(torque == Approx(1e4 * spring));  // as wide as R* instead of mu_r R*
}

TEST_CASE("what Yade's friction of grains that stick has otherwise is said with numbers") {
  for (const auto basis : {FrictionBasis::total, FrictionBasis::net}) {
    SlumpTest material = slump_of_paste();
    material.contact.normal = NormalLaw::dmt;
    material.contact.bridge.shape = BridgeShape::none;
    material.contact.friction_basis = basis;
    material = std::get<SlumpTest>(with_contact_of(material, default_values()));
    const auto written = export_yade(scene(material));
    REQUIRE(written.ok());
    // 4 pi gamma R* of two reference grains, each of radius 2 R*; of the total force friction feels twice the pull
    // more.
    const double pull = 2 * std::numbers::pi * material.contact.surface_energy_j_m2 * material.grains.radius_m;
    const double held = basis == FrictionBasis::total ? 2 * material.contact.friction * pull : 0;
    char text[80];
    std::snprintf(text, sizeof text, "with up to %.3g N in Yade and %.3g N with the card's law",
                  material.contact.friction * pull, held);
    CHECK_THAT(text_of(written.value()), Catch::Contains(text));
  }
}
