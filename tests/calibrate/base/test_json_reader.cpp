#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/base/json_reader.h"
#include "tests/calibrate/files.h"

namespace pastefit {
namespace {

using test::at;
using test::says;

Faults faults_of(std::string_view text) {
  Faults faults;
  parse_json(text, faults);
  return faults;
}

TEST_CASE("text that is not JSON is refused with line and column") {
  const Faults faults = faults_of("{\n  \"a\": 1,\n  \"b\": oops\n}");
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].where == "line 3, column 8");
  CHECK(says(faults[0], "not JSON"));
}

TEST_CASE("an empty text, NaN, a number too large and bytes that are no text are not JSON") {
  for (const char* text : {"", "{\"a\": NaN}", "{\"a\": 1e999}", "{\"\xff\": 1}", "{} {}", "{\"a\": 1,}"})
    CHECK(faults_of(text).size() == 1);
}

TEST_CASE("comments are allowed") {
  CHECK(faults_of("// one\n{\"a\": 1 /* two */}").empty());
}

TEST_CASE("a key that stands twice is a fault at its place, at any depth") {
  const Faults faults = faults_of(R"({"a": {"b": 1, "b": 2}, "list": [{}, {"c": 1, "c": 1}], "a": 3})");
  REQUIRE(faults.size() == 3);
  CHECK(faults[0].where == "a.b");
  CHECK(faults[1].where == "list[1].c");
  CHECK(faults[2].where == "a");
  CHECK(faults_of(R"([{"a": 1}, {"a": 1}])").empty());
}

TEST_CASE("nesting beyond the bound is refused instead of followed") {
  CHECK(faults_of(std::string(32, '[') + std::string(32, ']')).empty());
  CHECK(faults_of(std::string(100000, '[')).size() == 1);
}

TEST_CASE("a reader gathers every fault of an object") {
  Faults faults;
  const auto document = parse_json(
      R"({"height_mm": "70", "count": 42.3, "mass_kg": null, "size_mm": -1, "twin": 1, "kind": "mon", "widht_mm": 3})",
      faults);
  double number = 7;
  int count = 7;
  bool twin = true;
  int kind = 0;
  constexpr std::array<Named<int>, 2> kinds{{{"mono", 1}, {"normal", 2}}};
  {
    ObjectReader reader(*document, "test", faults);
    CHECK_FALSE(reader.number("height_mm", number, {}, Need::required));
    CHECK_FALSE(reader.integer("count", count, 0, 100, Need::required));
    CHECK_FALSE(reader.number("mass_kg", number, {}, Need::optional));
    CHECK_FALSE(reader.number("size_mm", number, {0, 10, true}, Need::required));
    CHECK_FALSE(reader.flag("twin", twin, Need::required));
    CHECK_FALSE(reader.choice("kind", kind, kinds, Need::required));
    CHECK_FALSE(reader.number("width_mm", number, {}, Need::required));
    CHECK_FALSE(reader.number("absent_mm", number, {}, Need::optional));
  }
  CHECK(number == 7);
  CHECK(count == 7);
  CHECK(twin);
  REQUIRE(faults.size() == 8);
  CHECK(says(at(faults, "test.height_mm"), "is the text \"70\"; write 70, without quotes"));
  CHECK(says(at(faults, "test.count"), "42.3; must be a whole number, 0 to 100"));
  CHECK(says(at(faults, "test.mass_kg"), "is null"));
  CHECK(says(at(faults, "test.size_mm"), "is -1 mm; must be above 0 and at most 10 mm"));
  CHECK(says(at(faults, "test.twin"), "true or false"));
  CHECK(says(at(faults, "test.kind"), "did you mean \"mono\"?"));
  CHECK(says(at(faults, "test.width_mm"), "is missing"));
  CHECK(says(at(faults, "test.widht_mm"), "did you mean \"width_mm\"?"));
}

TEST_CASE("an unknown key that is near to nothing is answered with the known ones") {
  Faults faults;
  const auto document = parse_json(R"({"zzzzzzzzzzzz": 1})", faults);
  double number = 0;
  { ObjectReader(*document, "", faults).number("height_mm", number, {}, Need::optional); }
  REQUIRE(faults.size() == 1);
  CHECK(says(faults[0], "known here: \"height_mm\""));
}

TEST_CASE("millimetres become the nearest metres") {
  Faults faults;
  const auto document = parse_json(R"({"a_mm": 57.2, "b_mm": 65})", faults);
  double a = 0, b = 0;
  ObjectReader reader(*document, "", faults);
  reader.number("a_mm", a, {}, Need::required, 1000);
  reader.number("b_mm", b, {}, Need::required, 1000);
  CHECK(a == 0.0572);
  CHECK(b == 0.065);
}

TEST_CASE("a seed keeps all its 64 bits, and is no fraction") {
  Faults faults;
  const auto document = parse_json(R"({"seed": 18446744073709551615, "half": 0.5, "minus": -1})", faults);
  std::uint64_t seed = 0, untouched = 3;
  ObjectReader reader(*document, "", faults);
  CHECK(reader.integer("seed", seed, Need::required));
  CHECK(seed == 18446744073709551615u);
  CHECK_FALSE(reader.integer("half", untouched, Need::required));
  CHECK_FALSE(reader.integer("minus", untouched, Need::required));
  CHECK(untouched == 3);
}

TEST_CASE("a file that is missing, or a folder, is one fault with its path") {
  Faults faults;
  CHECK_FALSE(read_json("no/such/file.json", faults));
  CHECK_FALSE(read_json(std::filesystem::temp_directory_path(), faults));
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].where == "no/such/file.json");
  CHECK(says(faults[1], "is a folder; give a file"));
}

TEST_CASE("the message lists every fault on its line, with place and remedy") {
  const Faults faults = in_file({{"a.b", "is missing", "add it"}, {"", "is empty", ""}}, "mix.json");
  CHECK(message_of(faults) == "mix.json: a.b: is missing; add it\nmix.json: is empty");
}

TEST_CASE("control characters of a file do not reach the terminal") {
  Faults faults;
  const auto document = parse_json(R"({"kind": "\u001b[2J", "\u001b[2J": 1, "\u001b": 1, "\u001b": 2})", faults);
  int kind = 0;
  constexpr std::array<Named<int>, 1> kinds{{{"mono", 1}}};
  { ObjectReader(*document, "", faults).choice("kind", kind, kinds, Need::required); }
  REQUIRE(faults.size() == 4);
  CHECK(message_of(faults).find('\x1b') == std::string::npos);
}

}  // namespace
}  // namespace pastefit
