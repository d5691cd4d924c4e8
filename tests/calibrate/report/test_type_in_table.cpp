#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/report/summary.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;

namespace {

Card shipped(const std::string& name) {
  auto read = read_card(std::string(PASTEFIT_SOURCE_DIR) + "/data/cards/" + name + ".json");
  REQUIRE(read.ok());
  return std::move(read).value();
}

const TypeInRow& row_of(const std::vector<TypeInGroup>& groups, const std::string& title, const std::string& quantity) {
  const auto group = std::ranges::find_if(groups, [&](const auto& one) { return one.title.starts_with(title); });
  REQUIRE(group != groups.end());
  const auto row = std::ranges::find(group->rows, quantity, &TypeInRow::quantity);
  REQUIRE(row != group->rows.end());
  return *row;
}

/// A card of which nothing but what a test changes speaks against it.
Card without_reservations() {
  Card card = shipped("concrete-mix-79");
  for (auto& parameter : card.material.parameters) parameter.free = false;
  for (auto& run : card.tests[0].baseline.runs) run.readings.set("step1.lateral_shift_mm", 5);
  for (auto& one : card.tests[0].readings)
    if (one.measured) one.simulated.mean = *one.measured;
  return card;
}

}  // namespace

TEST_CASE("what a person types in holds the density of a grain, which is not that of the material") {
  const Card card = shipped("concrete-mix-79");
  const auto groups = type_in_table(card);
  const TypeInRow& density = row_of(groups, "Grains", "density of a grain");
  CHECK(density.value == card.material.grain_density_kg_m3);
  CHECK(density.value > 1.3 * card.material.bulk_density_kg_m3);
  CHECK_THAT(density.remark, Catch::Contains("2349.2 kg/m3"));
}

TEST_CASE("what a person types in is complete: moduli, each pair of surfaces, and the bridge") {
  const Card card = shipped("concrete-mix-79");
  const auto groups = type_in_table(card);
  const ContactModel& contact = card.material.contact;
  CHECK(row_of(groups, "Grains", "radius").value == Approx(1e3 * card.material.grains.radius_m));
  CHECK(row_of(groups, "Grains", "shear modulus").value ==
        Approx(1e-6 * contact.youngs_modulus_pa / (2 * (1 + contact.poissons_ratio))));
  CHECK(row_of(groups, "Grain on grain", "sliding friction").value == contact.friction);
  CHECK(row_of(groups, "Grain on grain", "rolling friction").value == contact.rolling_friction);
  const auto& slump = std::get<SlumpTest>(card.tests[0].test);
  CHECK(row_of(groups, "Grain on table", "sliding friction").value == slump.table_wall.friction);
  CHECK(row_of(groups, "Grain on table", "rolling friction").value == slump.table_wall.rolling_friction);
  CHECK(row_of(groups, "Grain on mould", "sliding friction").value == slump.mould_wall.friction);
  CHECK(row_of(groups, "Attraction across a gap", "a").value == contact.bridge.a_n_m2);
  CHECK(row_of(groups, "Attraction across a gap", "d_c").value == Approx(1e3 * contact.bridge.d_c_m));
  CHECK(row_of(groups, "Attraction across a gap", "cohesion").value == Approx(contact.cohesion_n.value()));
}

TEST_CASE("grains without attraction have no bridge to type in, and grains of several sizes their range") {
  Card card = shipped("concrete-mix-79");
  card.material.contact.bridge.shape = BridgeShape::none;
  card.material.grains = {SizeDistribution::uniform, 0.008, 0, 0.006, 0.01};
  const auto groups = type_in_table(card);
  CHECK(std::ranges::none_of(groups, [](const auto& one) { return one.title.starts_with("Attraction"); }));
  CHECK(row_of(groups, "Grains", "largest radius").value == Approx(10));
}

TEST_CASE("numbers have the digits that a person types") {
  CHECK(typed(0.29999999999999999) == "0.3");
  CHECK(typed(2047.8940470323016) == "2047.9");
  CHECK(typed(-8.000000000000001) == "-8");
}

TEST_CASE("a terminal of 80 columns holds every line of what is typed in") {
  Card card = shipped("concrete-mix-79");
  for (const NormalLaw law : {NormalLaw::hertz, NormalLaw::jkr, NormalLaw::luding}) {
    card.material.contact.normal = law;
    std::string lines = type_in_lines(card);
    for (std::size_t end; (end = lines.find('\n')) != std::string::npos; lines.erase(0, end + 1)) CHECK(end <= 80);
  }
}

TEST_CASE("what a person types in has the law of the damping") {
  Card card = shipped("concrete-mix-79");
  CHECK_THAT(type_in_lines(card), Catch::Contains("2 sqrt(5/6) beta sqrt(S m*)") && Catch::Contains("a = sqrt(R* d)"));
  card.material.contact.normal = NormalLaw::luding;
  CHECK_THAT(type_in_lines(card), Catch::Contains("S = 2 E* a") && Catch::Contains("a = 2/3 R*"));
}

TEST_CASE("a verdict has no reservation where nothing speaks against the card") {
  const Card card = without_reservations();
  CHECK(reservations_on(card).empty());
  CHECK_THAT(verdict_of(card), !Catch::Contains("reservation"));
}

TEST_CASE("heaps that sheared off, a parameter at its bound and a marginal reading are reservations of the verdict") {
  Card card = without_reservations();
  card.tests[0].baseline.runs[0].readings.set("step1.lateral_shift_mm", 55);
  auto& strength = card.material.parameters[0];
  strength.free = true;
  strength.lower = strength.value;
  strength.upper = 10 * strength.value;
  for (auto& one : card.tests[0].readings)
    if (one.name == "step1.height_mm") one.simulated.mean = *one.measured + 0.95 * one.tolerance;
  const auto reservations = reservations_on(card);
  REQUIRE(reservations.size() == 3);
  const auto heaps = std::to_string(card.tests[0].baseline.runs.size());
  CHECK_THAT(reservations[0], Catch::Contains("1 of " + heaps + " heaps sheared off"));
  CHECK_THAT(reservations[1], Catch::Contains("step1.height_mm is off by") && Catch::Contains("of the 7.5 allowed"));
  CHECK_THAT(reservations[2], Catch::Contains("strength_pa") && Catch::Contains("lower bound"));
  CHECK_THAT(verdict_of(card), Catch::Contains("reproduces the measurement, with reservations"));
  const std::string summary = summary_of(card);
  for (const std::string& one : reservations)
    CHECK_THAT(summary, Catch::Contains(wrapped("Reservation: " + one + ".")));
}

TEST_CASE("a fitted friction that no grains have is a reservation that says what it stands for") {
  Card card = without_reservations();
  const auto set = [&](std::string_view name, double value, bool free) {
    Parameter& one = *std::ranges::find(card.material.parameters, name, &Parameter::name);
    one.value = value;
    one.free = free;
    one.lower = 0.001;
    one.upper = 1.5;
  };
  set("rolling_friction", 0.9, true);
  REQUIRE(reservations_on(card).size() == 1);
  CHECK(reservations_on(card)[0].starts_with("rolling_friction 0.9, plausible 0 to 0.5: these grains hardly roll"));
  set("friction", 0.02, true);
  CHECK(reservations_on(card).size() == 2);
  set("friction", 0.02, false);  // a value that the study's author chose
  set("rolling_friction", 0.5, true);
  CHECK(reservations_on(card).empty());
}

TEST_CASE("the readings of a single packing have no error") {
  Card card = without_reservations();
  card.confirmation.packings = {1};
  for (auto& one : card.tests[0].readings) {
    one.simulated.standard_deviation = 0;
    one.simulated.count = 1;
  }
  CHECK_THAT(summary_of(card), !Catch::Contains("+- 0 ") && Catch::Contains("Simulated: one packing, error unknown"));
  CHECK_THAT(verdict_of(card), Catch::Contains("with reservations") && Catch::Contains("one packing, error unknown"));
  CHECK(reservations_on(card) == std::vector<std::string>{"one packing, error unknown"});
  card.rescaled.push_back({0.01, {{"step1.height_mm", 100, 102, 0}}});
  CHECK_THAT(text_of(card), !Catch::Contains("+- 0 ") && Catch::Contains("bias +2 (one packing, error"));
  CHECK_FALSE(to_json(card).at("tests")[0].at("readings").at("step1.height_mm").contains("standard_error"));
}

TEST_CASE("a card whose adhesion grows with the pressure says near which pressure it holds") {
  Card card = without_reservations();
  ContactModel& contact = card.material.contact;
  contact.normal = NormalLaw::epa;
  contact.bridge = {};
  contact.cohesion_n = 0;
  REQUIRE(reservations_on(card).size() == 1);
  CHECK_THAT(reservations_on(card)[0], Catch::Contains("grows with the pressure") && Catch::Contains("6.91 kPa"));
  contact.cohesion_n = 0.05;
  CHECK(reservations_on(card).empty());
}

TEST_CASE("what a person types in holds the longest time step") {
  const Card card = shipped("concrete-mix-79");
  const TypeInRow step = row_of(type_in_table(card), "Grains", "longest time step");
  CHECK(step.unit == "s");
  const ContactModel& contact = card.material.contact;
  const double shear = contact.youngs_modulus_pa / (2 * (1 + contact.poissons_ratio));
  const double radius = card.material.grains.distribution == SizeDistribution::mono ? card.material.grains.radius_m
                                                                                    : card.material.grains.smallest_m;
  const double rayleigh = std::numbers::pi * radius * std::sqrt(*card.material.grain_density_kg_m3 / shear) /
                          (0.1631 * contact.poissons_ratio + 0.8766);
  CHECK(step.value <= 0.1 * rayleigh);
  CHECK(step.value > 0.02 * rayleigh);
}

TEST_CASE("the source that a starting file leaves to fill in is nobody's") {
  Card card = shipped("concrete-mix-79");
  card.tests[0].lab.source = "laboratory, person, date";
  const auto read = card_from_json(nlohmann::json::parse(to_json(card).dump()));
  REQUIRE(read.ok());
  CHECK(read.value().tests[0].lab.source.empty());
  CHECK(text_of(read.value()).find("laboratory, person, date") == std::string::npos);
}

TEST_CASE("an end of an interval that is the study's bound is marked in a card's text") {
  Card card = shipped("concrete-mix-79");
  const auto free = std::ranges::find(card.material.parameters, true, &Parameter::free);
  REQUIRE(free != card.material.parameters.end());
  card.inference.level = 0.95;
  card.inference.intervals = {{free->name, free->lower, 0.5 * (free->lower + free->upper)}};
  CHECK(ends_at_bounds(card.inference.intervals[0], *free).lower);
  CHECK_FALSE(ends_at_bounds(card.inference.intervals[0], *free).upper);
  CHECK_THAT(text_of(card), Catch::Contains("(the study's bound) to"));
}
