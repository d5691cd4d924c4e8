#include "calibrate/base/units.h"

#include <catch2/catch.hpp>

namespace pastefit {

TEST_CASE("units are known in their usual spellings") {
  for (const char* word : {"in", "inch", "IN", "inches", "\""}) CHECK(unit_of_word(word).value().factor == 25.4);
  for (const char* word : {"lb/ft3", "lbs/ft^3", "lb/ft³", "pcf"})
    CHECK(unit_of_word(word).value().factor == Approx(16.018463));
  CHECK(unit_of_word("kg/l").value().factor == 1000);
  CHECK(unit_of_word("psi").value().factor == Approx(6894.757));
  CHECK_FALSE(unit_of_word("furlong"));
}

TEST_CASE("a number is in the unit of its key, or of the object that it stands in") {
  CHECK(unit_of_place("measurements.step1.height_mm.repeats[2]").value().name == "mm");
  CHECK(unit_of_place("material.bulk_density_kg_m3").value().name == "kg/m3");
  CHECK(unit_of_place("apparatus.lift_velocity_mm_s").value().name == "mm/s");
  CHECK(unit_of_place("parameters.strength_pa.free[0]").value().name == "Pa");
  CHECK_FALSE(unit_of_place("weights.step1.height_mm"));
  CHECK_FALSE(unit_of_place("parameters.friction.value"));
  CHECK_FALSE(unit_of_place("test.mould.height_m"));  // of a card, which nobody types
}

TEST_CASE("a number is told in the units in which it would lie in its range") {
  CHECK(in_other_units(33, "mm", 196, 900) == "33 cm are 330 mm, 33 in are 838.2 mm");
  CHECK(in_other_units(2.35, "kg_m3", 1000, 3000) ==
        "2.35 kg/l are 2350 kg/m3, 2.35 g/cm3 are 2350 kg/m3, 2.35 t/m3 are "
        "2350 kg/m3");
  CHECK(in_other_units(-1, "mm", 0, 900).empty());
}

TEST_CASE("numbers are read as people write them, and nothing else is") {
  CHECK(written_number("7.25 in").value().unit.value().name == "in");
  CHECK(written_number("162,5").value().value == 162.5);
  CHECK(written_number("162,5").value().comma);
  CHECK(written_number(" 2.35kg/l ").value().unit.value().factor == 1000);
  for (const char* text : {"", "heavy", "12 furlong", "1,2,3", "nan", "1e999", "mm"}) CHECK_FALSE(written_number(text));
}

}  // namespace pastefit
