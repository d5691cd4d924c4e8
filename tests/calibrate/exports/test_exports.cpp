#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <sstream>

#include "calibrate/exports/export.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/exports/parameter_table.h"
#include "calibrate/exports/soulie.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/attraction.h"
#include "core/laws/constants.h"

using namespace pastefit;

namespace {

constexpr double kRadius = 0.008;
constexpr GrainPair kPair{kRadius, kRadius, kRadius};

SlumpTest paste() {
  SlumpTest out;
  out.grains.radius_m = kRadius;
  return std::get<SlumpTest>(with_contact_of(with_usual_contact(out), usual_values()));
}

/// A mould with three grains in it: exporters do not care how it was filled.
ExportScene scene(const SlumpTest& test) {
  ExportScene out;
  out.title = "Paste";
  out.test = test;
  out.packing.centres = {{0, 0, kRadius}, {0.05, 0, kRadius}, {0, 0.05, 0.1}};
  out.packing.radii.assign(3, kRadius);
  out.grain_density_kg_m3 = 3800;
  out.sizes = size_classes(out.packing.radii);
  return out;
}

std::string text_of(const Export& written) {
  std::string text;
  for (const auto& file : written.files) text += file.content;
  for (const auto& note : written.notes) text += note + "\n";
  return text;
}

}  // namespace

TEST_CASE("the curve that is exported is the one the engine acts by, for every shape") {
  ContactModel contact = paste().contact;
  auto& bridge = contact.bridge;
  bridge.a_n_m2 = 2000;
  bridge.b_n_m = 40;
  bridge.liquid_volume_m3 = 1e-9;
  bridge.surface_tension_n_m = 3;
  const GrainPair uneven{0.006, 0.010, kRadius};
  const double s = uneven.size_scale();
  const auto compare = [&](auto law) {
    const auto constants = grain_pair(contact, kRadius);
    for (const double share : {0.0, 0.3, 0.7, 0.999}) {
      const double d = -share * s * constants.rupture_gap;
      CHECK(attraction_n(contact, uneven, d) == Approx(law(constants, d)).epsilon(1e-12));
    }
    CHECK(attraction_n(contact, uneven, -1.001 * s * constants.rupture_gap) == 0);
    CHECK(attraction_n(contact, uneven, 1e-5) == Approx(s * s * constants.cohesion));
  };
  bridge.shape = BridgeShape::polynomial;
  compare([&](const auto& k, double d) { return PolynomialAttraction::at<double>(k, d, s).force; });
  bridge.shape = BridgeShape::linear;
  compare([&](const auto& k, double d) { return PolynomialAttraction::at<double>(k, d, s).force; });
  bridge.shape = BridgeShape::exponential;
  compare([&](const auto& k, double d) { return ExponentialAttraction::at<double>(k, d, s).force; });
  bridge.shape = BridgeShape::capillary;
  compare([&](const auto& k, double d) { return CapillaryAttraction::at<double>(k, d, s).force; });
}

TEST_CASE("the work of a bridge is the integral of its force") {
  const auto contact = paste().contact;
  const auto& b = contact.bridge;
  const double closed = -(b.a_n_m2 * std::pow(b.d_c_m, 3) / 3 + b.b_n_m * b.d_c_m * b.d_c_m / 2 + b.c_n * b.d_c_m);
  CHECK(bridge_work_j(contact, kPair, 0, -b.d_c_m) == Approx(closed).epsilon(1e-9));
}

TEST_CASE("a force table has a row at rupture and one at touch") {
  const auto contact = paste().contact;
  const auto table = force_table(contact, kPair, 0.1 * kRadius, 2001);
  CHECK(table.size() == 2001);
  CHECK(table[0].overlap_m == contact.bridge.d_c_m);
  CHECK(std::ranges::count(table, 0.0, &ForcePoint::overlap_m) == 1);
  CHECK(table.back().overlap_m >= 0.0999 * kRadius);
}

TEST_CASE("classes keep the volume of the grains, and one size stays as it is") {
  const std::vector<double> same(5, kRadius);
  CHECK(size_classes(same).radii_m == std::vector<double>{kRadius});
  CHECK(size_classes(same).largest_change == 0);
  std::vector<double> radii;
  for (int i = 0; i < 100; ++i) radii.push_back(0.004 + 0.00006 * i);
  const auto classes = size_classes(radii, 6);
  CHECK(classes.radii_m.size() == 6);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    before += std::pow(radii[i], 3);
    after += std::pow(classes.radii_m.at(classes.class_of[i]), 3);
  }
  CHECK(after == Approx(before));
  CHECK(classes.largest_change < 0.13);
}

TEST_CASE("the test that is exported is the one that is named, or else the first") {
  Card card;
  card.title = "Paste";
  for (const char* name : {"slow", "fast"}) {
    auto& test = card.tests.emplace_back();
    test.name = name;
    test.test = paste();
  }
  CHECK(test_to_export(card, "").value().name == "slow");
  CHECK(test_to_export(card, "fast").value().name == "fast");
  const auto none = test_to_export(card, "fats");
  REQUIRE_FALSE(none.ok());
  CHECK(none.faults()[0].where == "--test fats");
  CHECK_THAT(none.faults()[0].remedy, Catch::Contains("slow, fast"));
  card.tests[0].test = PelletCrush{};
  CHECK(test_to_export(card, "").value().name == "fast");
  CHECK(test_to_export(card, "slow").value().name == "slow");
}

TEST_CASE("every exporter writes files, and says what it loses") {
  for (const auto& exporter : exporters()) {
    INFO(exporter.name);
    const auto written = exporter.write(scene(paste()));
    REQUIRE(written.ok());
    CHECK(written.value().files.size() >= 3);
    CHECK_FALSE(written.value().notes.empty());
    const auto text = text_of(written.value());
    CHECK_THAT(text, !Catch::Contains("nan") && !Catch::Contains("inf ") && !Catch::Contains("inf\n"));
  }
}

TEST_CASE("what LAMMPS as it stands cannot represent is said with a number") {
  SlumpTest material = paste();
  material.contact.bridge.offset_m = 0.1 * -material.contact.bridge.d_c_m;
  material.contact.friction_basis = FrictionBasis::total;
  const auto written = export_lammps_tables(scene(material));
  REQUIRE(written.ok());
  const auto text = text_of(written.value());
  // c (1 - gap/reach): from 0.2 of the reach on, 64 % of the work
  CHECK_THAT(text, Catch::Contains("no memory") && Catch::Contains("64.0 % of the work"));
  CHECK_THAT(text, Catch::Contains("friction is of the total normal force"));
  material.contact.bridge.offset_m = -material.contact.bridge.d_c_m;
  CHECK_THAT(text_of(export_lammps_tables(scene(material)).value()), !Catch::Contains("no memory"));
}

TEST_CASE("a law the target lacks is refused, with a remedy") {
  SlumpTest material = paste();
  material.contact.rolling = static_cast<RollingModel>(static_cast<int>(RollingModel::last) + 1);
  material.table_wall.cohesion_factor = 0.5;
  for (const auto write : {&export_lammps_tables, &export_yade}) {
    const auto written = write(scene(material));
    REQUIRE_FALSE(written.ok());
    CHECK(written.faults().size() == 2);
  }
  material.contact.rolling = RollingModel::constant_torque;
  CHECK(export_liggghts(scene(material)).ok());
}

TEST_CASE("grains that stick beside a bridge are refused by each target, with one fault") {
  SlumpTest material = paste();
  material.contact.normal = NormalLaw::jkr;
  material.contact.surface_energy_j_m2 = 5;
  for (const auto& exporter : exporters()) {
    INFO(exporter.name);
    const auto written = exporter.write(scene(material));
    REQUIRE_FALSE(written.ok());
    REQUIRE(written.faults().size() == 1);
    const bool has_jkr = exporter.name != "lammps" && exporter.name != "csv" && exporter.name != "mercurydpm";
    CHECK(written.faults()[0].where == (has_jkr ? "test.contact.bridge.shape" : "test.contact.normal"));
    CHECK_THAT(written.faults()[0].what, Catch::Contains(has_jkr ? "\"polynomial\"" : "\"jkr\""));
    CHECK_THAT(written.faults()[0].remedy, Catch::Contains(has_jkr ? "attraction \"none\"" : "normal \"hertz\""));
  }
}

TEST_CASE("JKR without a bridge goes to EDEM, which has it, with its surface energy") {
  SlumpTest material = paste();
  material.contact.normal = NormalLaw::jkr;
  material.contact.bridge.shape = BridgeShape::none;
  std::vector<double> values = usual_values();
  material = std::get<SlumpTest>(with_contact_of(material, values));
  const auto written = export_edem_notes(scene(material));
  REQUIRE(written.ok());
  const auto text = text_of(written.value());
  CHECK_THAT(text, Catch::Contains("surface_energy_j_m2,8,") && Catch::Contains("Hertz-Mindlin with JKR"));
  CHECK_THAT(text, !Catch::Contains("force.csv"));
}

TEST_CASE("a law of grains that stick goes to the targets that have it or one of the same pull-off, and to no others") {
  const std::map<std::string, std::map<std::string_view, std::string>> takers{
      {"jkr",
       {{"lammps-tables", " jkr 2000000 "},
        {"edem-notes", "Hertz-Mindlin with JKR"},
        {"liggghts", "cohesion sjkr2"},
        {"yade", "SURFACE_ENERGY = "}}},
      {"dmt", {{"lammps-tables", " dmt 2000000 "}, {"liggghts", "cohesion sjkr2"}, {"yade", "SURFACE_ENERGY = 8\n"}}},
      {"sjkr", {{"liggghts", "cohesionEnergyDensity peratomtypepair 3 25000 0 0 "}, {"yade", "SURFACE_ENERGY = "}}}};
  for (const auto& [word, law] : normal_laws) {
    if (law == NormalLaw::hertz) continue;
    SlumpTest material = paste();
    material.contact.normal = law;
    material.contact.bridge.shape = BridgeShape::none;
    material = std::get<SlumpTest>(with_contact_of(material, usual_values()));
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
  SlumpTest material = paste();
  material.contact.normal = NormalLaw::jkr;
  material.contact.bridge.shape = BridgeShape::none;
  return std::get<SlumpTest>(with_contact_of(material, usual_values()));
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

TEST_CASE("a card without a slump test goes to DEM programs as its law: two grains, and the walls to copy") {
  const std::map<std::string_view, std::pair<std::string, std::string>> lines{
      {"lammps-tables", {"pair_coeff   1 1 jkr 2000000 ", "# fix          tools all wall/gran/region granular hertz"}},
      {"liggghts",
       {"pair_style   gran model hertz tangential history cohesion sjkr2 rolling_friction cdt",
        "# fix tools all wall/gran"}},
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
  const auto written = export_lammps_tables(pellet());
  REQUIRE(written.ok());
  const auto text = text_of(written.value());
  CHECK_THAT(text, Catch::Contains("turn by 0.00") && Catch::Contains(" rolling sds "));
  const auto at = text.find(" rolling sds ");
  double stiffness = 0, dashpot = 0, coefficient = 0;
  REQUIRE(std::sscanf(text.c_str() + at, " rolling sds %lf %lf %lf", &stiffness, &dashpot, &coefficient) == 3);
  CHECK(coefficient == 0.01);
  auto springs = pellet();
  specimen_of(springs.test).contact.rolling = RollingModel::spring_dashpot;
  const auto soft = text_of(export_lammps_tables(springs).value());
  double card_stiffness = 0;
  REQUIRE(std::sscanf(soft.c_str() + soft.find(" rolling sds "), " rolling sds %lf", &card_stiffness) == 1);
  CHECK(stiffness == Approx(1e4 * card_stiffness));  // as wide as R* instead of mu_r R*
}

TEST_CASE("what LAMMPS's JKR has otherwise is said with numbers") {
  SlumpTest material = paste();
  material.contact.normal = NormalLaw::jkr;
  material.contact.bridge.shape = BridgeShape::none;
  material.contact.friction_basis = FrictionBasis::elastic;
  material = std::get<SlumpTest>(with_contact_of(material, usual_values()));
  const auto written = export_lammps_tables(scene(material));
  REQUIRE(written.ok());
  // 3 pi gamma R* with gamma 8 J/m^2 and R* 4 mm
  CHECK_THAT(text_of(written.value()),
             Catch::Contains("(0.302 N), at 0.481 of the gap") && Catch::Contains("Two grains that only stick hold"));
}

TEST_CASE("what Yade's friction of grains that stick has otherwise is said with numbers") {
  for (const auto basis : {FrictionBasis::total, FrictionBasis::net}) {
    SlumpTest material = paste();
    material.contact.normal = NormalLaw::dmt;
    material.contact.bridge.shape = BridgeShape::none;
    material.contact.friction_basis = basis;
    material = std::get<SlumpTest>(with_contact_of(material, usual_values()));
    const auto written = export_yade(scene(material));
    REQUIRE(written.ok());
    // 4 pi gamma R* of two reference grains, each of radius 2 R*; of the total force friction feels twice the pull
    // more.
    const double pull = 2 * std::numbers::pi * material.contact.surface_energy_j_m2 * material.grains.radius_m;
    const double held = basis == FrictionBasis::total ? 2 * material.contact.friction * pull : 0;
    char text[80];
    std::snprintf(text, sizeof text, "holds %.3g N in Yade, %.3g N on the card", material.contact.friction * pull,
                  held);
    CHECK_THAT(text_of(written.value()), Catch::Contains(text));
  }
}

TEST_CASE("an attraction of every law is written by every exporter, and its curve is the card's") {
  for (const auto& [word, shape] : bridge_shapes) {
    SlumpTest material = paste();
    material.contact.bridge.shape = shape;
    material = std::get<SlumpTest>(with_contact_of(material, usual_values()));
    for (const auto& exporter : exporters()) {
      INFO(exporter.name << ", " << word);
      const auto written = exporter.write(scene(material));
      REQUIRE(written.ok());
      CHECK_THAT(text_of(written.value()), !Catch::Contains("nan") && !Catch::Contains("-inf"));
    }
    const ContactModel& contact = material.contact;
    const auto force = force_csv(scene(material)).content;
    const double half = -0.5 * rupture_gap(contact.bridge, kRadius);
    const auto table = force_table(contact, kPair, 0.1 * kRadius, 2001);
    const auto near =
        std::ranges::min_element(table, {}, [&](const ForcePoint& point) { return std::abs(point.overlap_m - half); });
    CHECK(near->attraction_n == Approx(bridge_force(contact.bridge, kRadius, near->overlap_m)).epsilon(1e-9));
    std::ostringstream row;
    row.precision(17);
    row << near->overlap_m << "," << near->attraction_n;
    CHECK_THAT(force, Catch::Contains(row.str()));
  }
}

TEST_CASE("a law that an exporter was not told of is refused, not misread") {
  const auto unheard = static_cast<BridgeShape>(static_cast<int>(BridgeShape::last) + 1);
  for (const auto write : {&export_lammps, &export_yade}) {
    ExportScene one = scene(paste());
    specimen_of(one.test).contact.bridge.shape = unheard;
    const auto written = write(one);
    REQUIRE_FALSE(written.ok());
    CHECK(written.faults()[0].where == "test.contact.bridge.shape");
  }
}

TEST_CASE("sizes become types in LAMMPS's tables, each pair with its own table") {
  auto several = scene(paste());
  several.packing.radii = {0.006, 0.008, 0.010};
  several.sizes = size_classes(several.packing.radii);
  const auto written = export_lammps_tables(several);
  REQUIRE(written.ok());
  const auto text = text_of(written.value());
  CHECK_THAT(text,
             Catch::Contains("3 atom types") && Catch::Contains("ATTRACTION_1_1") && Catch::Contains("ATTRACTION_2_3"));
}

TEST_CASE("LIGGGHTS's bridge is fitted: a bridge of its own kind is found again") {
  const SoulieBridge truth{kRadius, std::pow(0.4 * kRadius, 3), 2.5};
  // Its curve as a polynomial of second degree through touch, middle and rupture.
  ContactModel contact = paste().contact;
  const double reach = truth.rupture_gap_m();
  const double f0 = truth.force_n(0), f1 = truth.force_n(0.5 * reach), f2 = truth.force_n(reach * (1 - 1e-9));
  contact.bridge.c_n = f0;
  contact.bridge.d_c_m = -reach;
  contact.bridge.a_n_m2 = 2 * (f0 - 2 * f1 + f2) / (reach * reach);
  contact.bridge.b_n_m = (3 * f0 - 4 * f1 + f2) / reach;
  const auto fit = fit_soulie(contact, kRadius);
  CHECK(fit.bridge.rupture_gap_m() == Approx(reach).epsilon(0.01));
  CHECK(fit.bridge.surface_tension_n_m == Approx(2.5).epsilon(0.03));
  CHECK(fit.difference.largest < 0.05);
}
