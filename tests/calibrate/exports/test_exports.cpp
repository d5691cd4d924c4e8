#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/attraction.h"
#include "core/laws/constants.h"
#include "tests/calibrate/exports/scenes.h"

using namespace pastefit;
using namespace pastefit::export_scenes;

TEST_CASE("a text is filled in once, and never without a value for each of its names") {
  const std::string leg = "exports/texts/lammps_leg.in";
  const std::string text = filled_in(leg, {{"word", "@way@"}, {"steps", "2"}, {"number", "1"}, {"way", "0.5"}});
  CHECK(text.find("\"@way@ $(v_at") != std::string::npos);
  CHECK(text.find("move 0.5 0 0") != std::string::npos);
  CHECK_THROWS_AS(filled_in(leg, {{"word", "apart"}}), std::logic_error);
  CHECK_THROWS_AS(filled_in("exports/texts/none", {}), std::logic_error);
  CHECK_FALSE(embedded_text("exports/texts/none"));
}

TEST_CASE("the curve that is exported is the one the engine acts by, for every shape") {
  ContactModel contact = slump_of_paste().contact;
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
    // In overlap it passes over into the cohesion, in a straight line over a hundredth of a radius.
    const double passage = s * constants.passage, touch = s * s * constants.bridge_c, held = s * s * constants.cohesion;
    CHECK(attraction_n(contact, uneven, 1.001 * passage) == Approx(held));
    CHECK(attraction_n(contact, uneven, 0.25 * passage) == Approx(0.75 * touch + 0.25 * held));
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

TEST_CASE("a force table has a row at rupture and one at touch") {
  const auto contact = slump_of_paste().contact;
  const auto table = force_table(contact, kPair, 0.1 * kRadius, 2001);
  CHECK(table.size() == 2001);
  CHECK(table[0].overlap_m == contact.bridge.d_c_m);
  CHECK(std::ranges::count(table, 0.0, &ForcePoint::overlap_m) == 1);
  CHECK(table.back().overlap_m >= 0.0999 * kRadius);
}

TEST_CASE("classes keep the volume of the grains, and one size stays as it is") {
  const std::vector<double> same(5, kRadius);
  CHECK(size_classes(same).radii_m == std::vector<double>{kRadius});
  std::vector<double> radii;
  for (int i = 0; i < 100; ++i) radii.push_back(0.004 + 0.00006 * i);
  const auto classes = size_classes(radii, 6);
  CHECK(classes.radii_m.size() == 6);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    before += std::pow(radii[i], 3);
    after += std::pow(classes.radii_m.at(classes.class_of[i]), 3);
    CHECK(classes.radii_m.at(classes.class_of[i]) == Approx(radii[i]).epsilon(0.13));
  }
  CHECK(after == Approx(before));
}

TEST_CASE("the test that is exported is the one that is named, or else the first") {
  Card card;
  card.title = "Paste";
  for (const char* name : {"slow", "fast"}) {
    auto& test = card.tests.emplace_back();
    test.name = name;
    test.test = slump_of_paste();
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
    const auto written = exporter.write(scene(slump_of_paste()));
    REQUIRE(written.ok());
    CHECK(written.value().files.size() >= 3);
    CHECK_FALSE(written.value().notes.empty());
    const auto text = text_of(written.value());
    CHECK_THAT(text, !Catch::Contains("nan") && !Catch::Contains("inf ") && !Catch::Contains("inf\n"));
  }
}

TEST_CASE("where another law stands in for the card's, the export says which one the program has itself") {
  const std::map<std::string_view, std::string> own{
      {"lammps", ""}, {"yade", ""}, {"liggghts", "sjkr"}, {"edem-notes", "jkr"}};
  SlumpTest material = slump_of_paste();
  material.contact.friction_basis = FrictionBasis::total;
  for (const auto& exporter : exporters()) {
    const auto expected = own.find(exporter.name);
    if (expected == own.end()) continue;
    INFO(exporter.name);
    const auto written = exporter.write(scene(material));
    REQUIRE(written.ok());
    CHECK(written.value().own_law.empty() == expected->second.empty());
    CHECK_THAT(written.value().own_law, Catch::Contains(expected->second));
  }
}

TEST_CASE("a law the target lacks is refused, with a remedy") {
  SlumpTest material = slump_of_paste();
  material.contact.rolling = static_cast<RollingModel>(static_cast<int>(RollingModel::last) + 1);
  material.table_wall.cohesion_factor = 0.5;
  const auto written = export_yade(scene(material));
  REQUIRE_FALSE(written.ok());
  CHECK(written.faults().size() == 2);
  material.contact.rolling = RollingModel::constant_torque;
  CHECK(export_liggghts(scene(material)).ok());
}

TEST_CASE("an attraction of every law is written by every exporter, and its curve is the card's") {
  for (const auto& [word, shape] : bridge_shapes) {
    SlumpTest material = slump_of_paste();
    material.contact.bridge.shape = shape;
    material = std::get<SlumpTest>(with_contact_of(material, default_values()));
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
    CHECK_THAT(force, Catch::Contains("\n" + exact(near->overlap_m) + "," + exact(near->attraction_n) + ","));
  }
}

TEST_CASE("a law that an exporter was not told of is refused, not misread") {
  const auto unheard = static_cast<BridgeShape>(static_cast<int>(BridgeShape::last) + 1);
  for (const auto write : {&export_lammps, &export_yade}) {
    ExportScene one = scene(slump_of_paste());
    specimen_of(one.test).contact.bridge.shape = unheard;
    const auto written = write(one);
    REQUIRE_FALSE(written.ok());
    CHECK(written.faults()[0].where == "test.contact.bridge.shape");
  }
}

TEST_CASE("a viscosity is written for LAMMPS's style, and refused where the target lacks it") {
  ExportScene one = scene(slump_of_paste());
  specimen_of(one.test).contact.bridge.viscosity_pa_s = 2.5;
  for (const auto& exporter : exporters()) {
    INFO(exporter.name);
    const auto written = exporter.write(one);
    REQUIRE(written.ok() == (exporter.name == std::string("lammps")));
    if (written.ok()) {
      CHECK_THAT(text_of(written.value()), Catch::Contains("viscosity_pa_s 2.5"));
    } else {
      CHECK(written.faults().size() == 1);
      CHECK(written.faults()[0].where == "test.contact.bridge.viscosity_pa_s");
    }
  }
}

TEST_CASE("LIGGGHTS's bridge is fitted: a bridge of its own kind is found again") {
  const SoulieBridge truth{kRadius, std::pow(0.4 * kRadius, 3), 2.5};
  // Its curve as a polynomial of second degree through touch, middle and rupture.
  ContactModel contact = slump_of_paste().contact;
  const double reach = truth.rupture_gap_m();
  const double f0 = truth.force_n(0), f1 = truth.force_n(0.5 * reach), f2 = truth.force_n(reach * (1 - 1e-9));
  contact.bridge.c_n = f0;
  contact.bridge.d_c_m = -reach;
  contact.bridge.a_n_m2 = 2 * (f0 - 2 * f1 + f2) / (reach * reach);
  contact.bridge.b_n_m = (3 * f0 - 4 * f1 + f2) / reach;
  const auto fit = fit_soulie(contact, kRadius);
  CHECK(fit.bridge.rupture_gap_m() == Approx(reach).epsilon(0.01));
  CHECK(fit.bridge.surface_tension_n_m == Approx(2.5).epsilon(0.03));
  CHECK(fit.largest < 0.05);
}

TEST_CASE("a restitution that LIGGGHTS refuses is refused at export, of grains and walls") {
  SlumpTest material = slump_of_paste();
  material.contact.restitution = 0.02;
  material.table_wall.restitution = 0.05;
  const auto written = export_liggghts(scene(material));
  REQUIRE_FALSE(written.ok());
  REQUIRE(written.faults().size() == 2);
  CHECK(written.faults()[0].where == "test.contact.restitution");
  CHECK_THAT(written.faults()[0].what, Catch::Contains("0.02") && Catch::Contains("above 0.05"));
  CHECK(written.faults()[1].where == "test.table_wall.restitution");
  material.contact.restitution = material.table_wall.restitution = 0.06;
  CHECK(export_liggghts(scene(material)).ok());
}

TEST_CASE("the notes for EDEM give numbers: shear modulus, and the surface energy of the same force at touch") {
  SlumpTest material = slump_of_paste();
  material.contact.youngs_modulus_pa = 2e6;
  material.contact.poissons_ratio = 0.3;
  const auto text = text_of(export_edem_notes(scene(material)).value());
  CHECK_THAT(text, Catch::Contains("shear modulus 0.769231 MPa"));
  CHECK_THAT(text, !Catch::Contains("small coefficients") && !Catch::Contains("E/(2 (1 + nu))"));
  const std::string before = "surface energy of\n   ";
  REQUIRE(text.find(before) != std::string::npos);
  ContactModel jkr = material.contact;
  jkr.bridge.shape = BridgeShape::none;
  jkr.normal = NormalLaw::jkr;
  jkr.surface_energy_j_m2 = std::stod(text.substr(text.find(before) + before.size()));
  CHECK(sticking_of(jkr, 0.5 * kRadius).at_touch_n == Approx(attraction_n(material.contact, kPair, 0)).epsilon(1e-4));
}

TEST_CASE("the notes for EDEM name its rolling model, and everything that its dialogues and a plug-in ask for") {
  SlumpTest material = slump_of_paste();
  material.grains = {SizeDistribution::uniform, kRadius, 0, 0.006, 0.01};
  material.contact.rolling_friction = 0.2;
  material.contact.friction_basis = FrictionBasis::elastic;
  const auto notes = [&](RollingModel model) {
    material.contact.rolling = model;
    return text_of(export_edem_notes(scene(material)).value());
  };
  CHECK_THAT(notes(RollingModel::constant_torque), Catch::Contains("rolling model \"RVD\""));
  const std::string text = notes(RollingModel::spring_dashpot);
  for (const char* words :
       {"rolling model \"Type C\"", "Not \"Standard Rolling Friction\"", "lever R* = r1 r2/(r1 + r2)",
        "\n  formation_gap_m ", "lever over effective radius", "friction of the elastic normal force", "s = 2 R*/R",
        "scaled by s for other pairs of sizes", "\n  smallest_radius_m                       0.006",
        "\n  largest_radius_m                         0.01"})
    CHECK_THAT(text, Catch::Contains(words));
}

TEST_CASE("liquid and surface energy become parameters by the formulas of the manual") {
  const double tension = 0.072, volume = 2e-9, root = std::cbrt(volume);
  SlumpTest material = slump_of_paste();
  auto values = default_values();
  const auto set = [&](std::string_view name, double value) {
    const auto kinds = parameter_kinds();
    const auto at = std::ranges::find(kinds, name, &ParameterKind::name);
    REQUIRE(at != kinds.end());
    values[static_cast<std::size_t>(at - kinds.begin())] = value;
  };
  set("strength_pa", 2 * std::acos(-1.0) * tension / kRadius);
  set("rupture_gap_ratio", (root + 0.1 * root * root / kRadius) / kRadius);
  set("adhesion_pa", 8 / kRadius);
  material.contact.bridge.shape = BridgeShape::capillary;
  const auto liquid = std::get<SlumpTest>(with_contact_of(material, values)).contact.bridge;
  CHECK(liquid.surface_tension_n_m == Approx(tension));
  CHECK(liquid.liquid_volume_m3 == Approx(volume));
  material.contact.bridge.shape = BridgeShape::none;
  material.contact.normal = NormalLaw::jkr;
  CHECK(std::get<SlumpTest>(with_contact_of(material, values)).contact.surface_energy_j_m2 == Approx(8));
}
