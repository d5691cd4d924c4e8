#include <catch2/catch.hpp>
#include <filesystem>

#include "calibrate/exports/heap_dump.h"
#include "tests/calibrate/exports/scenes.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;
using namespace pastefit::export_scenes;

namespace {

const std::string kHead = "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n";
const std::string kColumnsLine = "ITEM: ATOMS id type x y z radius \n";
const std::string kTwo = kHead + kColumnsLine + "2 1 0.1 0.2 0.3 0.008\n1 1 -0.1 -2e-1 0.4 0.009\n";

void fails(const std::string& text, const std::string& where, const std::string& what) {
  const auto read = parse_dump(text, "heap.dump");
  REQUIRE_FALSE(read.ok());
  INFO(read.faults()[0].where << ": " << read.faults()[0].what);
  CHECK_THAT(read.faults()[0].where, Catch::Contains(where));
  CHECK_THAT(read.faults()[0].what, Catch::Contains(what));
  CHECK_FALSE(read.faults()[0].remedy.empty());
}

}  // namespace

TEST_CASE("a dump's last snapshot is read in the order of the grains' numbers, whatever the order of its columns") {
  const auto read = parse_dump(kTwo, "heap.dump");
  REQUIRE(read.ok());
  REQUIRE(read.value().count() == 2);
  CHECK(read.value().motion[0].radius == 0.009);
  CHECK(read.value().motion[1].radius == 0.008);
  const auto later = parse_dump(kTwo + kHead + "ITEM: ATOMS radius z y x id\r\n0.01 3 2 1 1\r\n0.02 6 5 4 2\r\n", "d");
  REQUIRE(later.ok());
  CHECK(later.value().motion[0].radius == 0.01);
  CHECK(later.value().motion[1].position.x == 4);
}

TEST_CASE("a dump that is not a whole one of grains is refused with the line") {
  fails("", "heap.dump", "no line \"ITEM: ATOMS");
  fails("{\"format\": \"pastefit-card-6\"}\n", "heap.dump", "no line \"ITEM: ATOMS");
  fails(kHead + kColumnsLine + "2 1 0.1 0.2 0.3 0.008\n", "line 10", "ends after 1 grains of 2");
  fails(kHead + kColumnsLine + "2 1 0.1 0.2 0.3 0.008\n1 1 0.1 0.2\n", "line 11", "holds 4 columns, the header 6");
  fails(kHead + "ITEM: ATOMS id type x y z\n1 1 0 0 0\n2 1 0 0 0\n", "line 9", "lacks the column radius");
  fails(kHead + "ITEM: ATOMS\n", "line 9", "lacks the column id");
  fails(kHead + kColumnsLine, "line 9", "no grain");
  fails("ITEM: NUMBER OF ATOMS\nmany\n" + kColumnsLine + "1 1 0 0 0 0.1\n", "line 2", "number of atoms");
}

TEST_CASE("a number of a dump that is none, not finite or not possible is refused with its column") {
  const auto with = [](const std::string& row) {
    return kHead + kColumnsLine + "2 1 0.1 0.2 0.3 0.008\n" + row + "\n";
  };
  fails(with("1 1 nan 0 0 0.008"), "line 11", "x is");
  fails(with("1 1 0 inf 0 0.008"), "line 11", "y is");
  fails(with("1 1 0 0 0x1 0.008"), "line 11", "z is");
  fails(with("1 1 0 0 1e4 0.008"), "line 11", "z is");
  fails(with("1 1 0 0 0 0"), "line 11", "radius is 0");
  fails(with("1.5 1 0 0 0 0.1"), "line 11", "id is");
  fails(with("2 1 0 0 0 0.1"), "heap.dump", "grain 2 twice");
}

TEST_CASE("of a dump with many faults the first twenty are listed") {
  std::string text = kColumnsLine;
  for (int i = 0; i < 100; ++i) text += "1 1 nan 0 0 0.1\n";
  CHECK(parse_dump(text, "heap.dump").faults().size() == 20);
}

TEST_CASE("a dump that is not a regular file or too large is refused unread") {
  const test::Folder folder;
  for (const auto& file : {folder.path() / "none.dump", folder.path(), std::filesystem::path("/dev/zero")})
    CHECK_FALSE(read_dump(file).ok());
  const auto large = folder.write("large.dump", kTwo);
  CHECK(read_dump(large).ok());
  std::filesystem::resize_file(large, kLargestDump + 1);
  const auto read = read_dump(large);
  REQUIRE_FALSE(read.ok());
  CHECK_THAT(read.faults()[0].what, Catch::Contains("larger than 512 MB"));
}

TEST_CASE("heaps of other grains than the card's mould holds are refused") {
  SlumpTest test = slump_of_paste();
  test.grains.radius_m = 0.016;
  const Particles two = parse_dump(kTwo, "d").value();
  const Particles heaps[] = {make_particles({{0, 0, 0}}, {0.008}, 1000)};
  const auto read = read_heaps(test, std::nullopt, two, heaps);
  REQUIRE_FALSE(read.ok());
  CHECK(read.faults().size() == 2);
  CHECK_FALSE(read_heaps(PelletCrush{}, std::nullopt, two, heaps).ok());
}
