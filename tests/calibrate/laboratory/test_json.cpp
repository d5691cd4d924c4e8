#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"
#include "tests/calibrate/files.h"

namespace pastefit {
namespace {

/// A test whose numbers have no short decimal form.
SlumpTest awkward() {
  auto test = std::get<SlumpTest>(with_default_contact(SlumpTest{}));
  test.bulk_density_kg_m3 = 2300.0 / 7 * 7.0000000001;
  test.contact.friction = 1.0 / 3;
  test.contact.bridge.offset_m = 0.0008000000000000001;
  test.table_wall.rolling_friction = 0.1 + 0.2 - 0.2;
  test.packing_seed = 0xfedcba9876543210u;
  return test;
}

TEST_CASE("a test survives JSON text bit for bit") {
  for (const bool drop : {false, true}) {
    SlumpTest test = awkward();
    if (drop) test.drop = DropPlate{0.7, 16.0 / 3, 0.04, 0.1 / 3};
    const std::string text = to_json(test).dump();
    const Result<Test> read = test_from_json(nlohmann::json::parse(text));
    REQUIRE(read.ok());
    const auto& back = std::get<SlumpTest>(read.value());
    CHECK(to_json(back).dump() == text);
    CHECK(back.bulk_density_kg_m3 == test.bulk_density_kg_m3);
    CHECK(back.contact.friction == test.contact.friction);
    CHECK(back.contact.bridge.offset_m == test.contact.bridge.offset_m);
    CHECK(back.contact.bridge.shape == BridgeShape::polynomial);
    CHECK(back.contact.cohesion_n == test.contact.cohesion_n);
    CHECK(back.table_wall.rolling_friction == test.table_wall.rolling_friction);
    CHECK(back.packing_seed == test.packing_seed);
    REQUIRE(back.drop.has_value() == drop);
    if (drop) CHECK(back.drop->mass_kg == test.drop->mass_kg);
  }
}

TEST_CASE("tests that differ in one bit differ in their text") {
  SlumpTest test = awkward();
  const std::string text = to_json(test).dump();
  test.contact.friction = std::nextafter(test.contact.friction, 1.0);
  CHECK(to_json(test).dump() != text);
}

TEST_CASE("another law of the overlap survives JSON, and is not in that of the default one") {
  SlumpTest test = awkward();
  const nlohmann::json by_default = to_json(test);
  CHECK_FALSE(by_default.at("contact").contains("normal"));
  CHECK_FALSE(by_default.at("contact").contains("surface_energy_j_m2"));
  test.contact.normal = NormalLaw::jkr;
  test.contact.surface_energy_j_m2 = 8.0 / 7;
  const nlohmann::json document = to_json(test);
  CHECK(document.at("contact").at("normal") == "jkr");
  const Result<Test> back = test_from_json(document);
  REQUIRE(back.ok());
  CHECK(specimen_of(back.value()).contact.normal == NormalLaw::jkr);
  CHECK(specimen_of(back.value()).contact.surface_energy_j_m2 == test.contact.surface_energy_j_m2);
  CHECK(to_json(std::get<SlumpTest>(back.value())).dump() == document.dump());
}

TEST_CASE("tests that differ in the law of the overlap alone, or in its energy, are different tests") {
  SlumpTest hertz = awkward();
  SlumpTest jkr = hertz;
  jkr.contact.normal = NormalLaw::jkr;
  CHECK(identity_of(jkr) != identity_of(hertz));
  SlumpTest stickier = jkr;
  stickier.contact.surface_energy_j_m2 = 1;
  CHECK(identity_of(stickier) != identity_of(jkr));
}

TEST_CASE("no cohesion of its own is written as null and read back as none") {
  SlumpTest test = awkward();
  test.contact.cohesion_n.reset();
  const nlohmann::json document = to_json(test);
  CHECK(document.at("contact").at("cohesion_n").is_null());
  const Result<Test> back = test_from_json(document);
  REQUIRE(back.ok());
  CHECK_FALSE(specimen_of(back.value()).contact.cohesion_n.has_value());
}

TEST_CASE("a missing, an unknown and a wrong key are all named") {
  nlohmann::json document = to_json(awkward());
  document["mould"].erase("height_m");
  document["contact"]["bridge"]["shape"] = "cubic";
  document["drop"] = 3;
  document["extra"] = 1;
  const Result<Test> back = test_from_json(document);
  REQUIRE_FALSE(back.ok());
  CHECK(back.faults().size() == 4);
  CHECK(test::says(test::at(back.faults(), "mould.height_m"), "missing"));
  CHECK(test::says(test::at(back.faults(), "contact.bridge.shape"), "\"polynomial\""));
  CHECK(test::says(test::at(back.faults(), "drop"), "null"));
  CHECK(test::says(test::at(back.faults(), "extra"), "unknown key"));
}

TEST_CASE("a test that cannot be simulated is refused") {
  nlohmann::json document = to_json(awkward());
  document["mould"]["height_m"] = -1;
  CHECK_FALSE(test_from_json(document).ok());
}

TEST_CASE("a test of a kind that this version does not know is refused") {
  nlohmann::json document = to_json(Test(awkward()));
  CHECK(document["kind"] == "slump");
  document["kind"] = "kneading";
  const Result<Test> back = test_from_json(document);
  REQUIRE_FALSE(back.ok());
  CHECK(test::says(test::at(back.faults(), "kind"), "kneading"));
}

}  // namespace
}  // namespace pastefit
