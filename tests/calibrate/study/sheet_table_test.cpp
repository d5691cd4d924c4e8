#include "calibrate/study/sheet_table.h"

#include <catch2/catch.hpp>
#include <string>

#include "calibrate/base/text.h"

namespace pastefit {
namespace {

using Typed = std::vector<std::pair<std::string, std::string>>;

SheetTable read_without_faults(std::string_view text, const Sheet& defaults = {}) {
  Faults faults;
  SheetTable table = sheet_table(text, defaults, faults);
  INFO(message_of(faults));
  REQUIRE(faults.empty());
  return table;
}

std::string message_for(std::string_view text) {
  Faults faults;
  sheet_table(text, {}, faults);
  return message_of(faults);
}

const std::string kGerman =
    "Prüfbuch 2026; Labor 3\n"
    "Probe;Form;Rohdichte (kg/dm³);Setzmaß 1 (cm);Setzmaß 2 (cm);Breite [mm];Zement (kg/m³);Prüfer\n"
    "A/12;abrams;2,35;18,0;17,5;330;310,5;Müller\n"
    ";;;;;;;\n"
    "A/13;abrams;2,28;-;;270;330;Müller\n";

void check_german(const SheetTable& table) {
  REQUIRE(table.rows.size() == 2);
  const SheetRow& first = table.rows[0];
  CHECK(first.name == "a-12");
  CHECK(first.line == 3);
  CHECK(first.sheet.title == "A/12");
  CHECK(first.sheet.mould == "abrams");
  CHECK(first.sheet.density == "2.35 kg/dm³");
  CHECK(first.sheet.readings == Typed{{"slump", "18.0 cm; 17.5 cm"}, {"spread", "330 mm"}});
  REQUIRE(first.sheet.mix.size() == 1);
  CHECK(first.sheet.mix[0] == std::pair<std::string, double>("zement_kg_m3", 310.5));
  CHECK(table.rows[1].sheet.readings == Typed{{"spread", "270 mm"}});
  CHECK(table.unused == std::vector<std::string>{"Prüfer"});
}

/// Of code points below 0x800, as the text has.
std::string in_utf_16(std::string_view utf8, bool big_endian) {
  std::string out;
  const auto add = [&](unsigned code) {
    const char low = static_cast<char>(code & 255), high = static_cast<char>(code >> 8);
    out += big_endian ? std::string{high, low} : std::string{low, high};
  };
  add(0xFEFF);
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto letter = static_cast<unsigned char>(utf8[i]);
    if (letter < 0x80)
      add(letter);
    else
      add((letter & 31u) << 6 | (static_cast<unsigned char>(utf8[++i]) & 63u));
  }
  return out;
}

std::string in_windows_1252(std::string_view utf8) {
  std::string out;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto letter = static_cast<unsigned char>(utf8[i]);
    out +=
        letter < 0x80 ? utf8[i] : static_cast<char>((letter & 3u) << 6 | (static_cast<unsigned char>(utf8[++i]) & 63u));
  }
  return out;
}

}  // namespace

TEST_CASE("a German workbook's table is read in each encoding that it is saved in") {
  check_german(read_without_faults(kGerman));
  check_german(read_without_faults("\xEF\xBB\xBF" + kGerman));
  check_german(read_without_faults(in_utf_16(kGerman, false)));
  check_german(read_without_faults(in_utf_16(kGerman, true)));
  check_german(read_without_faults(in_windows_1252(kGerman)));
  std::string with_returns;
  for (const char letter : kGerman) with_returns += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  check_german(read_without_faults(with_returns));
}

TEST_CASE("a table between commas has repeats, fractions of an inch and commas in quotes") {
  const auto table = read_without_faults(
      "Sample,Mold,Unit weight (lb/ft3),\"Slump, in\",Slump flow (in)\n"
      "\"B1, wet\",abrams,146.7,7 1/4\",13\n"
      "\"B \"\"2\"\"\",\"8/4/12 in\",146,\"7; 7.5\",\"13, 14\"\n");
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0].sheet.title == "B1, wet");
  CHECK(table.rows[0].sheet.density == "146.7 lb/ft3");
  CHECK(table.rows[0].sheet.readings == Typed{{"slump", "7 1/4\""}, {"spread", "13 in"}});
  CHECK(table.rows[1].sheet.title == "B \"2\"");
  CHECK(table.rows[1].sheet.readings == Typed{{"slump", "7; 7.5 in"}, {"spread", "13, 14 in"}});
}

TEST_CASE("a number behind a head is that of a repeat, and of a reading after the drop where none is the first") {
  const auto repeats = read_without_faults("slump1,slump2,slump 3\n180,175,190\n");
  CHECK(repeats.rows[0].sheet.readings == Typed{{"slump", "180; 175; 190"}});
  const auto steps = read_without_faults("height,height2,h2\n118,90,91\n");
  CHECK(steps.rows[0].sheet.readings == Typed{{"height", "118"}, {"height2", "90; 91"}});
  const auto both = read_without_faults("h1;h2\n118;90\n");
  CHECK(both.rows[0].sheet.readings == Typed{{"height", "118"}, {"height2", "90"}});
}

TEST_CASE("units may stand in the head, below it or in the cell") {
  for (const char* text : {"density (t/m3)\tslump [cm]\n2.3\t18\n", "density\tslump\n(t/m3)\tcm\n2.3\t18\n",
                           "density_t_m3\tslump_cm\n2.3\t18\n", "density\tslump\n2.3 t/m3\t18 cm\n"}) {
    INFO(text);
    const auto table = read_without_faults(text);
    REQUIRE(table.rows.size() == 1);
    CHECK(table.rows[0].sheet.density.starts_with("2.3 t"));
    CHECK(table.rows[0].sheet.readings == Typed{{"slump", "18 cm"}});
  }
}

TEST_CASE("what a row does not say is as the options have it") {
  Sheet defaults;
  defaults.mould = "abrams";
  defaults.density = "2300";
  defaults.readings = {{"spread", "330"}, {"slump", "100"}};
  const auto table = read_without_faults("density,slump,height\n,180,\n2400,n/a,120\n", defaults);
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0].sheet.density == "2300");
  CHECK(table.rows[0].sheet.readings == Typed{{"slump", "180"}, {"spread", "330"}});
  CHECK(table.rows[1].sheet.density == "2400");
  CHECK(table.rows[1].sheet.readings ==
        Typed{{"height", "120"}, {"spread", "330"}});  // not measured is not the option's
  CHECK(table.rows[0].sheet.title == "line 2");
  CHECK(table.rows[0].name == "line-2");
}

TEST_CASE("every fault of a table has its line and head") {
  const std::string twice = message_for("sample,slump\nx,180\nX,170\n");
  CHECK_THAT(twice, Catch::Contains("line 3") && Catch::Contains("as line 2 has"));
  const std::string heads = message_for("density,rohdichte,slump (furlongs)\n2300,2300,1\n");
  CHECK_THAT(heads, Catch::Contains("\"rohdichte\"") && Catch::Contains("\"furlongs\", which is not known"));
  CHECK_THAT(message_for("slump,drops,water (kg/m3)\n180,often,wet\n"),
             Catch::Contains("line 2, \"drops\"") && Catch::Contains("line 2, \"water (kg/m3)\""));
  CHECK_THAT(message_for("sample,date\nx,today\n"), Catch::Contains("no line that names a reading"));
  CHECK_THAT(message_for("sample,slump\nx,n/a\n"), Catch::Contains("no row with a reading"));
  CHECK_THAT(message_for(""), Catch::Contains("no line that names a reading"));
}

TEST_CASE("what may be misread in silence is an error with its line or head") {
  const auto refused = [](const char* text, const char* words) {
    INFO(text);
    CHECK_THAT(message_for(text), Catch::Contains(words));
  };
  refused("no;slump\n1;\"180\n2;170\n3;160\"\n4;150\n", "line 2: has a quotation mark that closes in a later line");
  refused("sample,slump,spread\nA,17,5,330\n", "line 2: has more cells than the header row: \"330\"");
  refused("height,spread,height2,spread 2\n120,330,100,350\n", "may be a repeat, or the reading after the drop");
  refused("slump 5;slump 30;slump 60\n180;175;165\n", "numbers do not count repeats");
  refused("slump;slump 1;slump 2\n175;180;170\n", "numbers do not count repeats");
  refused("slump (mm);slump (in)\n178;7\n", "has another unit than \"slump (mm)\"");
  refused("slump,cement (kg/m3)\n180,\"1,200\"\n", "line 2, \"cement (kg/m3)\"");
  refused("slump;cement (kg/m3)\n180;1.200\n", "line 2, \"cement (kg/m3)\"");
}

TEST_CASE("thousands, lists, means and densities of another kind are not taken for readings") {
  CHECK(read_without_faults("slump;spread\n180,175;330\n").rows[0].sheet.readings[0].second ==
        "180,175");  // refused later
  CHECK(read_without_faults("slump;spread \xC3\x98\n180;330\n").rows[0].sheet.readings == Typed{{"slump", "180"}});
  const auto table = read_without_faults("sample;slump;trockenrohdichte (kg/m3)\nA;180;2100\nMittelwert;180;2100\n");
  CHECK(table.rows.size() == 1);
  CHECK(table.statistics == std::vector<std::size_t>{3});
  CHECK(table.rows[0].sheet.mix.empty());
  CHECK(table.unused == std::vector<std::string>{"trockenrohdichte (kg/m3)"});
}

TEST_CASE("a line of units below the head counts for the mix as well, whatever stands beside them") {
  const auto table = read_without_faults("probe;zement;luft;setzmass\nEinheit;kg/m3;%;cm\nA;310;2;18\n");
  REQUIRE(table.rows.size() == 1);
  CHECK(table.mix == std::vector<std::string>{"zement"});
  CHECK(table.rows[0].sheet.readings == Typed{{"slump", "18 cm"}});
}

TEST_CASE("cells, rows and columns beyond all use are errors, and take no time") {
  const std::string digits(2'000'000, '1');
  CHECK_THAT(message_for("slump;spread\n" + digits + ",5;330\n"), Catch::Contains("2000002 letters"));
  Faults faults;
  CHECK(sheet_table("slump," + std::string(2'000'000, 'x') + "(mm)\n180,1\n", {}, faults).rows.size() == 1);
  CHECK(faults.empty());
  // A quotation mark within a cell is looked at once.
  CHECK_THAT(message_for("slump\nx" + std::string(2'000'000, '"') + "\n"), Catch::Contains("2000001 letters"));
  std::string head = "slump 1", cells = "180", rows = "slump\n";
  for (int i = 0; i < 100'000; ++i) {
    head += ",slump 2";
    cells += ",180";
    rows += "180\n";
  }
  CHECK_THAT(message_for(head + "\n" + cells + "\n"), Catch::Contains("300 columns or more"));
  CHECK_THAT(message_for(rows), Catch::Contains("1000 samples or more"));
}

TEST_CASE("a row without a reading is named, not lost in silence") {
  CHECK(read_without_faults("sample,slump\nx,180\ny,\nz,170\n").without == std::vector<std::size_t>{3});
}

}  // namespace pastefit
