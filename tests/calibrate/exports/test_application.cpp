#include <boost/math/distributions/students_t.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "calibrate/base/text.h"
#include "calibrate/exports/application.h"
#include "calibrate/exports/key_figures.h"
#include "tests/calibrate/exports/scenes.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;
using namespace pastefit::export_scenes;

namespace {

const std::string kSquare = R"(solid floor
facet normal 0 0 0
 outer loop
  vertex -200 -200 0
  vertex 200 -200 0
  vertex 200 200 0
 endloop
endfacet
facet normal 0 0 0
 outer loop
  vertex -200 -200 0
  vertex -200 -200 0
  vertex 200 200 0
 endloop
endfacet
endsolid floor
)";

/// The same triangle twice, binary: one with an area, one without.
std::string binary_square() {
  std::string out(80, ' ');
  const auto put = [&](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t{2});
  for (const float second : {200.0F, -200.0F}) {
    for (const float number : {0.0F, 0.0F, 1.0F, -200.0F, -200.0F, 0.0F, second, -200.0F, 0.0F, 200.0F, 200.0F, 0.0F})
      put(number);
    put(std::uint16_t{0});
  }
  return out;
}

const std::string kMachine = R"({
  "format": "pastefit-application-1", "title": "Machine",
  "parts": {
    "floor": {"file": "floor.stl", "friction": 0.25},
    "gate": {"file": "floor.stl", "unit": "m", "slide": {"from_s": 3, "velocity_m_s": [0, 0.5, 0], "distance_mm": 500}},
    "blade": {"file": "floor.stl",
              "rotation": {"from_s": 2, "point_mm": [0, 0, 100], "axis": [0, 0, 2], "revolutions_per_min": -30}}
  },
  "feed": {"centre_mm": [0, 0, 500], "radius_mm": 100, "velocity_m_s": [0, 0, -1], "mass_kg": 10, "rate_kg_s": 10},
  "outlet": {"point_mm": [0, 0, -10], "normal": [0, 0, -2]},
  "duration_s": 6
})";

Result<Application> machine(const test::Folder& folder, const std::string& text = kMachine) {
  folder.write("floor.stl", kSquare);
  WallContact table;
  table.friction = 0.7;
  return read_application(folder.write("machine.json", text), table);
}

std::string with(std::string text, const std::string& what, const std::string& other) {
  const auto at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), other);
}

std::string message(const Result<Application>& read) {
  REQUIRE_FALSE(read.ok());
  return message_of(read.faults());
}

/// 2 kg/s from 1 s on until 6 of 8 kg have left; the depth is the time in metres, the force 3 N and once 9 N.
std::string run_of_figures(double scale = 1) {
  std::string out = "time_s,end_s,fed_kg,inside_kg,flow_depth_m,chute_force_n\n";
  for (int n = 0; n <= 500; ++n) {
    const double time = 0.01 * n, left = std::clamp(2 * (time - 1), 0.0, 6.0);
    out += format("%.10g,5,%.10g,%.10g,%.10g,%.10g\n", time, 8 * scale, (8 - left) * scale, time, n == 40 ? 9.0 : 3.0);
  }
  return out;
}

double figure(const KeyFigures& found, const std::string& name) {
  const auto one = std::ranges::find(found.figures, name, &KeyFigure::name);
  REQUIRE(one != found.figures.end());
  return one->mean();
}

}  // namespace

TEST_CASE("an STL file is read alike in ASCII and in binary, without triangles that have no area") {
  const test::Folder folder;
  const auto ascii = read_stl(folder.write("a.stl", kSquare), 0.001);
  const auto binary = read_stl(folder.write("b.stl", binary_square()), 0.001);
  REQUIRE(ascii.ok());
  REQUIRE(binary.ok());
  REQUIRE(ascii.value().size() == 1);
  CHECK(ascii.value()[0][1].x == Approx(0.2));
  CHECK(stl_text("same", ascii.value()) == stl_text("same", binary.value()));
  CHECK_FALSE(read_stl(folder.write("c.stl", "solid nothing\nendsolid nothing\n"), 1).ok());
  CHECK_FALSE(read_stl(folder.write("d.stl", kSquare.substr(0, kSquare.find("vertex 200 200"))), 1).ok());
  for (const char* corner : {"nan 200 0", "1,5 200 0", "1e400 200 0", "1e30 200 0"}) {
    INFO(corner);
    CHECK_FALSE(read_stl(folder.write("e.stl", with(kSquare, "200 200 0", corner)), 1).ok());
    const std::string first = with(kSquare, "-200 -200 0", corner);  // what follows it is not dropped in silence
    CHECK_FALSE(read_stl(folder.write("f.stl", first + kSquare), 1).ok());
  }
  CHECK_FALSE(read_stl(folder.path() / "missing.stl", 1).ok());
}

TEST_CASE("a part is like the card's table where its file says nothing else") {
  const test::Folder folder;
  const auto read = machine(folder);
  REQUIRE(read.ok());
  const auto& parts = read.value().parts;
  const auto part = [&](const std::string& name) { return *std::ranges::find(parts, name, &MachinePart::name); };
  CHECK(part("floor").contact.friction == 0.25);
  CHECK(part("gate").contact.friction == 0.7);
  CHECK(part("floor").triangles[0][1].x == Approx(0.2));
  CHECK(part("gate").triangles[0][1].x == Approx(200));
  CHECK(part("gate").slide->until_s() == Approx(4));
  CHECK(read.value().start_s() == 3);
}

TEST_CASE("every error of a machine is named with its place") {
  const test::Folder folder;
  const auto fault = [&](const std::string& what, const std::string& other) {
    return message(machine(folder, with(kMachine, what, other)));
  };
  CHECK(fault("floor.stl", "other.stl").find("parts.floor.file: \"other.stl\"") != std::string::npos);
  CHECK(fault("\"floor\":", "\"my floor\":").find("parts.my floor: is not a name of a part") != std::string::npos);
  CHECK(fault("[0, 0, -1]", "[0, 0, 0]").find("feed.velocity_m_s: has no direction") != std::string::npos);
  CHECK(fault("\"duration_s\": 6", "\"duration_s\": 4").find("duration_s: is 4 s") != std::string::npos);
  CHECK(fault("\"normal\": [0, 0, -2]", "\"normal\": [0, 0, 2]").find("outlet.normal: puts the feed") !=
        std::string::npos);
  CHECK(fault("-30", "0").find("parts.blade.rotation.revolutions_per_min: is 0") != std::string::npos);
  CHECK(fault("\"friction\": 0.25", "\"friction\": -1").find("parts.floor.friction") != std::string::npos);
  CHECK(fault("\"unit\": \"m\"", "\"units\": \"m\"").find("parts.gate.units: unknown key") != std::string::npos);
  CHECK(fault("pastefit-application-1", "pastefit-lab-1").find("format") != std::string::npos);
  const std::string both = fault("\"file\": \"floor.stl\",\n",
                                 "\"file\": \"floor.stl\", \"slide\": {\"from_s\": 3, "
                                 "\"velocity_m_s\": [0, 1, 0], \"distance_mm\": 500},\n");
  CHECK(both.find("parts.blade: slides and rotates") != std::string::npos);
  const Application read = machine(folder).value();
  CHECK(unsuitable_grains(read, 0.02, 3000).empty());
  CHECK(unsuitable_grains(read, 0.03, 3000).at(0).where == "feed.radius_mm");
  CHECK(unsuitable_grains(read, 0.02, 1000).at(0).where == "feed.rate_kg_s");
  CHECK(unsuitable_grains(read, 1e-5, 3000).at(0).where == "feed.mass_kg");
  // 30 revolutions per minute, 0.2 sqrt(2) m from the axis; the gate has 0.5 m/s and the feed 1 m/s.
  CHECK(fastest_m_s(read) == Approx(1));
  CHECK(fastest_m_s(machine(folder, with(kMachine, "-30", "-300")).value()) ==
        Approx(10 * 3.14159265 * 0.2 * std::sqrt(2.0)));
}

TEST_CASE("the deck of a machine moves its parts in order, and counts time from the last start of a motion") {
  const test::Folder folder;
  ExportScene one = scene(slump_of_paste());
  one.application = machine(folder).value();
  const auto written = export_liggghts(one);
  REQUIRE(written.ok());
  const std::string deck = written.value().files.at(0).content;
  const auto at = [&](const std::string& text) {
    INFO(text);
    const auto found = deck.find(text);
    REQUIRE(found != deck.npos);
    return found;
  };
  at("create_box   4 box");
  at("mesh n_meshes 3 meshes part_blade part_floor part_gate");
  const auto turns = at("move_blade all move/mesh mesh part_blade rotate origin 0 0 0.1 axis -0 -0 -2 period 2\n");
  const auto opens = at("move_gate all move/mesh mesh part_gate linear 0 0.5 0\n");
  const auto stops = at("unfix        move_gate\n");
  CHECK(turns < opens);
  CHECK(opens < stops);
  at("variable     time_s equal step*dt-(3)");
  at("variable     end_s equal 3");
  CHECK(written.value().heap.empty());
  one.application = machine(folder, with(kMachine, "-30", "-9000")).value();
  CHECK_FALSE(export_liggghts(one).ok());
}

TEST_CASE("a title cannot add a command to the deck of a machine, nor a part take the place of its feed") {
  const test::Folder folder;
  ExportScene one = scene(slump_of_paste());
  std::string hostile = with(kMachine, "\"Machine\"", R"("Machine\nshell touch x\n#")");
  hostile = with(hostile, "\"floor\":", "\"feed\":");
  one.application = machine(folder, hostile).value();
  const auto written = export_liggghts(one);
  REQUIRE(written.ok());
  CHECK(written.value().files.at(0).content.find("\nshell") == std::string::npos);
  std::vector<std::string> names;
  for (const ExportFile& file : written.value().files) names.push_back(file.name);
  std::ranges::sort(names);
  CHECK(std::ranges::adjacent_find(names) == names.end());
}

TEST_CASE("a rotating part sweeps the circle about its axis, wherever the point of the axis lies") {
  const test::Folder folder;
  const auto far = machine(folder, with(kMachine, "\"point_mm\": [0, 0, 100]", "\"point_mm\": [0, 0, 100000]"));
  REQUIRE(far.ok());
  CHECK(far.value().bounds().second.z == Approx(0.6));  // of the feed
}

TEST_CASE("key figures are those of a run whose figures are known in closed form") {
  const test::Folder folder;
  folder.write("figures.csv", run_of_figures());
  const auto found = read_key_figures(folder.path());
  REQUIRE(found.ok());
  CHECK(figure(found.value(), "fed_kg") == Approx(8));
  CHECK(figure(found.value(), "discharged_kg") == Approx(6));
  CHECK(figure(found.value(), "remaining_kg") == Approx(2));
  CHECK(figure(found.value(), "discharge_rate_kg_s") == Approx(2));
  CHECK(figure(found.value(), "time_to_50_percent_s") == Approx(3));
  // 20 to 80 % of 6 kg leave between 1.6 and 3.4 s.
  CHECK(figure(found.value(), "flow_depth_mm") == Approx(2500).margin(10));
  CHECK(figure(found.value(), "chute_force_mean_n") == Approx(3));
  CHECK(figure(found.value(), "chute_force_max_n") == Approx(9));
}

TEST_CASE("runs of three materials and more have a band, by Student's t") {
  const test::Folder folder;
  double scale = 0.9;
  for (const char* name : {"material-1", "material-2", "material-3"}) {
    std::filesystem::create_directory(folder.path() / name);
    folder.write(std::string(name) + "/figures.csv", run_of_figures(scale));
    scale += 0.1;
  }
  const auto found = read_key_figures(folder.path());
  REQUIRE(found.ok());
  CHECK(found.value().runs == std::vector<std::string>{"material-1", "material-2", "material-3"});
  const KeyFigure& fed = found.value().figures.at(0);
  const double half = boost::math::quantile(boost::math::students_t(2), 0.95) * 0.8 * std::sqrt(4.0 / 3);
  CHECK(fed.mean() == Approx(8));
  REQUIRE(fed.band());
  CHECK(fed.band()->first == Approx(8 - half));
  CHECK(fed.band()->second == Approx(8 + half));
}

TEST_CASE("figures of a run that has not ended, or of none, are refused") {
  const test::Folder folder;
  CHECK_FALSE(read_key_figures(folder.path()).ok());
  const std::string all = run_of_figures();
  folder.write("figures.csv", all.substr(0, all.find("\n3,") + 1));
  const auto early = read_key_figures(folder.path());
  REQUIRE_FALSE(early.ok());
  CHECK(early.faults().at(0).what == "ends at 2.99 s of 5 s");
  folder.write("figures.csv", with(all, "\n3,5,8", "\n3,5,nan"));
  CHECK_FALSE(read_key_figures(folder.path()).ok());
  folder.write("figures.csv", with(all, "end_s,fed", "time_s,fed"));
  CHECK(read_key_figures(folder.path()).faults().at(0).what == "has a column twice");
  const test::Folder several;
  std::filesystem::create_directory(several.path() / "material-1");
  several.write("material-1/in.application", "");
  CHECK(read_key_figures(several.path()).faults().at(0).what == "has not been run");
  folder.write("figures.csv", "");
  CHECK_FALSE(read_key_figures(folder.path()).ok());
}

TEST_CASE("grains stay until the end without an outlet, half of the time after a gate opens, and twice their fall") {
  Application machine;
  machine.duration_s = 10;
  machine.feed.mass_kg = 10;
  machine.feed.rate_kg_s = 5;  // the mean grain enters after 1 s
  machine.feed.centre_m = {0, 0, 2};
  CHECK(mean_residence_s(machine) == Approx(9));
  machine.outlet = OrientedPlane{{0, 0, 0}, {0, 0, -1}};
  CHECK(mean_residence_s(machine) == Approx(2 * std::sqrt(2 * 2 / 9.81)));
  machine.parts.emplace_back().slide = Slide{.from_s = 4, .velocity_m_s = {1, 0, 0}, .distance_m = 0.1};
  CHECK(mean_residence_s(machine) == Approx(7 - 1));
}
