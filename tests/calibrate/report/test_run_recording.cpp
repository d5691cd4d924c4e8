#include <zlib.h>

#include <array>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/report/run_recording.h"
#include "core/world/world.h"

using namespace pastefit;

namespace {

/// A world of grains at these places, all of 10 mm radius.
World world_of(std::vector<Vec3> places) {
  World world;
  const std::vector<double> radii(places.size(), 0.01);
  world.particles = make_particles(places, radii, 2000);
  return world;
}

RunRecording film_of_two_frames() {
  RunRecording film;
  RecordingPart part;
  part.radii_m = {0.01, 0.02};
  Wall table;
  table.name = "table";
  part.frames.push_back({0, "step1.lift", {{0, 0, 0}, {1, 2, 3}}, {0.0f, 1.0f}, {0, 1}, {0.0f, 0.5f}, {table}});
  part.frames.push_back(
      {0.5, "step1.rest", {{0, 0, -0.25}, {1, 2, 3.5}}, {10.0f, 1.0f}, {3, 0}, {2.0f, 1.0f}, {table}});
  film.parts.push_back(std::move(part));
  return film;
}

std::string bytes_in(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string packed;
  unsigned bits = 0;
  int held = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(letter));
    held += 6;
    if (held >= 8) packed += static_cast<char>(bits >> (held -= 8) & 0xFF);
  }
  std::string out(1000, '\0');
  uLongf size = out.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                     packed.size()) == Z_OK);
  out.resize(size);
  return out;
}

}  // namespace

TEST_CASE("a coded film says where each grain is, to half a quantum, by differences from the frame before") {
  const RunRecording film = film_of_two_frames();
  const auto index = nlohmann::json::parse(coded(film).index);
  const double quantum = index.at("quantum_m");
  CHECK(quantum == Approx(3.75 / 65535));  // wider than 16 bits of 0.05 mm
  const std::string bytes = bytes_in(coded(film).grains);
  REQUIRE(bytes.size() == 2 * 2 + 2 * (3 * 2 * 2 + 2 + 2 + 2));
  std::size_t place = 0;
  const auto octet = [&] { return static_cast<unsigned char>(bytes.at(place++)); };
  const auto words = [&] {
    std::array<unsigned, 2> out{};
    for (auto& one : out) one = octet();
    for (auto& one : out) one += 256u * octet();
    return out;
  };
  CHECK(words()[1] * quantum == Approx(0.02).margin(quantum));
  std::array<std::array<unsigned, 2>, 3> places{};
  for (const RecordedFrame& frame : film.parts[0].frames) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto step = words();
      for (std::size_t i = 0; i < 2; ++i) {
        places[axis][i] = (places[axis][i] + step[i]) % 65536;
        const Vec3 centre = frame.centres_m[i];
        const double expected = axis == 0 ? centre.x : axis == 1 ? centre.y : centre.z;
        CHECK(index.at("low_m")[axis].get<double>() + places[axis][i] * quantum == Approx(expected).margin(quantum));
      }
    }
    place += 6;
  }
  // Speeds of the first frame, 0 and 1 m/s, and what the second adds to them.
  CHECK(static_cast<unsigned char>(bytes.at(4 + 12)) == 0);
  CHECK(static_cast<unsigned char>(bytes.at(4 + 13)) == 4 * 51);
  CHECK(static_cast<unsigned char>(bytes.at(4 + 18 + 12)) == 255);
  // Pulls of the first frame, 0 and 0.5 N, and what the second adds to them; 2 N is the most.
  CHECK(index.at("most_pull_n") == 2);
  CHECK(static_cast<unsigned char>(bytes.at(4 + 16)) == 0);
  CHECK(static_cast<unsigned char>(bytes.at(4 + 17)) == 64);
  CHECK(static_cast<unsigned char>(bytes.at(4 + 18 + 16)) == 255);
  CHECK(static_cast<unsigned char>(bytes.at(4 + 18 + 17)) == 64);
}

TEST_CASE("the index of a film names a wall again only where it has moved") {
  RunRecording film = film_of_two_frames();
  film.parts[0].frames.push_back(film.parts[0].frames.back());
  film.parts[0].frames.back().walls[0].shape = Plane{{0, 0, 1}};
  const auto frames = nlohmann::json::parse(coded(film).index).at("reels")[0].at("frames");
  CHECK(frames[0].contains("walls"));
  CHECK_FALSE(frames[1].contains("walls"));
  CHECK(frames[2].at("walls")[0].at("point_m")[2] == 1);
}

TEST_CASE("a film begins a part where the grains are other ones, and its clock goes on") {
  RunRecorder recorder;
  World two = world_of({{0, 0, 0}, {0, 0, 1}}), one = world_of({{0, 0, 0}});
  for (const double time : {0.0, 0.02, 0.04}) recorder.add({"fill.pour", time, 0, &two});
  for (const double time : {0.0, 0.02}) recorder.add({"step1.lift", time, 0, &one});
  Snapshot second_drop{"step2.rest", 0.04, 0, &one};
  second_drop.drop = 1;
  recorder.add(second_drop);
  const RunRecording film = std::move(recorder).film();
  REQUIRE(film.parts.size() == 3);
  CHECK(film.grains() == 2);
  CHECK(film.parts[1].frames.front().time_s == Approx(0.04));
  CHECK(film.parts[1].frames.back().time_s == Approx(0.06));
  CHECK(film.parts[1].frames.size() == 2);
  CHECK(film.parts[1].frames.back().phase == "step1.lift");
  CHECK(film.parts[2].frames.front().time_s == Approx(0.06));
  CHECK(film.parts[2].frames.front().phase == "step2.rest, heap turned half round");
}

TEST_CASE("a film shows grains that grow as they are, on one clock") {
  RunRecorder recorder;
  World world = world_of({{0, 0, 0}, {0, 0, 1}});
  const double grown = world.particles.motion[0].radius;
  for (const double size : {0.8, 0.9, 1.0, 1.01}) {
    for (auto& grain : world.particles.motion) grain.radius = size * grown;
    recorder.add({"fill.grow", size, 0, &world});
  }
  const RunRecording film = std::move(recorder).film();
  REQUIRE(film.parts.size() == 3);
  CHECK(film.parts[0].radii_m[1] == Approx(0.8 * grown));
  CHECK(film.parts[2].radii_m[1] == Approx(grown));
  CHECK(film.parts[2].frames.back().time_s == Approx(1.01));
}

TEST_CASE("a long film is thinned to what a page holds, and keeps the last picture of each part") {
  RunRecorder recorder;
  World world = world_of({{0, 0, 0}});
  for (int k = 0; k <= 1000; ++k) recorder.add({"step1.rest", 0.02 * k, 0, &world});
  const RunRecording film = std::move(recorder).film();
  CHECK(film.frames() > 120);
  CHECK(film.frames() < 160);
  CHECK(film.parts[0].frames.back().time_s == Approx(20));
}

TEST_CASE("grains are told in the order of their identities, wherever they stand in the world") {
  RunRecorder recorder;
  World world = world_of({{0, 0, 1}, {0, 0, 2}});
  std::swap(world.particles.motion[0], world.particles.motion[1]);
  std::swap(world.particles.identity[0], world.particles.identity[1]);
  recorder.add({"step1.rest", 0, 0, &world});
  const RunRecording film = std::move(recorder).film();
  CHECK(film.parts[0].frames[0].centres_m[0].z == 1);
  CHECK(film.parts[0].frames[0].centres_m[1].z == 2);
}
