
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "calibrate/report/vtk.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;

TEST_CASE("a frame holds its numbers as the format asks: size and bytes in one base64 text") {
  const auto text = vtp_of({"Verts", 1, {{1, 2, 3}}, {0}, "PointData", {{"radius", std::vector<double>{0.008}}}});
  CHECK_THAT(text, Catch::Contains("NumberOfPoints=\"1\""));
  // 24 as UInt64, then 1.0, 2.0, 3.0; encoded with another program
  CHECK_THAT(text, Catch::Contains(">GAAAAAAAAAAAAAAAAADwPwAAAAAAAABAAAAAAAAACEA=<"));
  // 8 as UInt64, then 0.008
  CHECK_THAT(text, Catch::Contains(">CAAAAAAAAAD8qfHSTWKAPw==<"));
}

TEST_CASE("a series lists its frames with their times after every frame") {
  const test::Folder folder;
  VtkSeries series(folder.path(), "grains");
  CHECK(series.add(0, VtkFrame{}).empty());
  CHECK(series.add(0.25, VtkFrame{}).empty());
  std::ifstream in(series.index());
  std::ostringstream text;
  text << in.rdbuf();
  CHECK_THAT(text.str(), Catch::Contains("timestep=\"0\" file=\"grains_000000.vtp\"") &&
                             Catch::Contains("timestep=\"0.25\" file=\"grains_000001.vtp\""));
  CHECK(std::filesystem::exists(folder.path() / "grains_000001.vtp"));
  CHECK_FALSE(VtkSeries("/nowhere", "grains").add(0, VtkFrame{}).empty());
}
