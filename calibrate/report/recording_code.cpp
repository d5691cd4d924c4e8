#include "calibrate/report/recording_code.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "calibrate/base/text.h"

namespace pastefit {

namespace {

using nlohmann::ordered_json;

constexpr double kQuantum = 5e-5;  // [m]

/// Bounding box of all centres, and the length of one 16-bit step.
struct Box {
  std::array<double, 3> low{};
  double quantum = kQuantum;
};

std::array<double, 3> places_of(const Vec3& point) {
  return {point.x, point.y, point.z};
}

Box box_of(const RunRecording& film) {
  constexpr double kSteps = 65535;
  Box box;
  std::array<double, 3> high{};
  bool first = true;
  for (const RecordingPart& part : film.parts)
    for (const RecordedFrame& frame : part.frames)
      for (const Vec3& centre : frame.centres_m) {
        const auto place = places_of(centre);
        for (std::size_t c = 0; c < 3; ++c) {
          box.low[c] = first ? place[c] : std::min(box.low[c], place[c]);
          high[c] = first ? place[c] : std::max(high[c], place[c]);
        }
        first = false;
      }
  for (std::size_t c = 0; c < 3; ++c) box.quantum = std::max(box.quantum, (high[c] - box.low[c]) / kSteps);
  return box;
}

std::uint16_t steps(double length, double quantum) {
  return static_cast<std::uint16_t>(std::clamp(std::lround(length / quantum), 0L, 65535L));
}

std::uint8_t code_of_speed(float speed) {
  constexpr double kPerDecade = 51, kSlowest = 1e-4;
  return static_cast<std::uint8_t>(
      std::clamp(std::lround(kPerDecade * std::log10(std::max<double>(speed, kSlowest) / kSlowest)), 0L, 255L));
}

void append_bytes(std::string& bytes, const std::vector<std::uint16_t>& numbers) {
  for (const auto number : numbers) bytes += static_cast<char>(number & 0xFFu);
  for (const auto number : numbers) bytes += static_cast<char>(number >> 8);
}

/// Columns that are coded as differences from the frame before.
struct CodedColumns {
  std::array<std::vector<std::uint16_t>, 3> places;
  std::vector<std::uint8_t> speeds, touching, pulls;
};

float most_pull_n(const RunRecording& film) {
  float most = 0;
  for (const RecordingPart& part : film.parts)
    for (const RecordedFrame& frame : part.frames)
      for (const float pull : frame.pulls_n) most = std::max(most, pull);
  return most;
}

CodedColumns columns_of(const RecordedFrame& frame, const Box& box, float most_pull) {
  CodedColumns out;
  for (const Vec3& centre : frame.centres_m) {
    const auto place = places_of(centre);
    for (std::size_t c = 0; c < 3; ++c) out.places[c].push_back(steps(place[c] - box.low[c], box.quantum));
  }
  for (const float speed : frame.speeds_m_s) out.speeds.push_back(code_of_speed(speed));
  out.touching = frame.coordination;
  for (const float pull : frame.pulls_n)
    out.pulls.push_back(static_cast<std::uint8_t>(most_pull > 0 ? std::lround(255 * pull / most_pull) : 0));
  return out;
}

template <class Number>
std::vector<Number> change(const std::vector<Number>& now, const std::vector<Number>& before) {
  std::vector<Number> out(now);
  for (std::size_t i = 0; i < before.size(); ++i) out[i] = static_cast<Number>(now[i] - before[i]);
  return out;
}

void append_bytes(std::string& bytes, const CodedColumns& now, const CodedColumns& before) {
  for (std::size_t c = 0; c < 3; ++c) append_bytes(bytes, change(now.places[c], before.places[c]));
  for (const auto& [column, earlier] :
       {std::pair(&now.speeds, &before.speeds), std::pair(&now.touching, &before.touching),
        std::pair(&now.pulls, &before.pulls)})
    for (const auto byte : change(*column, *earlier)) bytes += static_cast<char>(byte);
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("the film could not be deflated");
  out.resize(size);
  return out;
}

ordered_json json_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

ordered_json json_of(const RecordedWall& wall) {
  ordered_json out{{"name", wall.name}};
  if (const auto* plane = std::get_if<Plane>(&wall.shape)) {
    out["shape"] = "plane";
    out["point_m"] = json_of(plane->point);
    out["normal"] = json_of(plane->normal);
  } else if (const auto* plate = std::get_if<Plate>(&wall.shape)) {
    out["shape"] = "plate";
    out["centre_m"] = json_of(plate->centre);
    out["along"] = json_of(plate->along);
    out["across"] = json_of(plate->across);
    out["half_m"] = {plate->half_length, plate->half_width};
  } else if (const auto* shell = std::get_if<Shell>(&wall.shape)) {
    out["shape"] = "shell";
    out["base_m"] = json_of(shell->base);
    out["radii_m"] = {shell->base_radius, shell->top_radius};
    out["height_m"] = shell->height;
  } else if (const auto* ribs = std::get_if<Ribs>(&wall.shape)) {
    out["shape"] = "ribs";
    out["base_m"] = json_of(ribs->base);
    out["thickness_m"] = ribs->thickness;
    out["height_m"] = ribs->height;
    out["pitch_m"] = ribs->pitch;
  }
  return out;
}

ordered_json index_of(const RunRecording& film, const Box& box, float most_pull) {
  ordered_json out{{"quantum_m", box.quantum}, {"low_m", box.low}, {"most_pull_n", most_pull}};
  auto& parts = out["reels"] = ordered_json::array();
  for (const RecordingPart& part : film.parts) {
    ordered_json of_reel{{"grains", part.radii_m.size()}};
    ordered_json standing;
    for (const RecordedFrame& frame : part.frames) {
      ordered_json of_frame{{"time_s", frame.time_s}, {"phase", frame.phase}};
      auto walls = ordered_json::array();
      for (const RecordedWall& wall : frame.walls) walls.push_back(json_of(wall));
      if (walls != standing) of_frame["walls"] = standing = std::move(walls);
      of_reel["frames"].push_back(std::move(of_frame));
    }
    parts.push_back(std::move(of_reel));
  }
  return out;
}

std::string bytes_of(const RunRecording& film, const Box& box, float most_pull) {
  std::string bytes;
  for (const RecordingPart& part : film.parts) {
    std::vector<std::uint16_t> radii;
    for (const double radius : part.radii_m) radii.push_back(steps(radius, box.quantum));
    append_bytes(bytes, radii);
    CodedColumns before;
    for (const RecordedFrame& frame : part.frames) {
      CodedColumns now = columns_of(frame, box, most_pull);
      append_bytes(bytes, now, before);
      before = std::move(now);
    }
  }
  return bytes;
}

}  // namespace

CodedRecording coded(const RunRecording& film) {
  if (film.frames() == 0) return {};
  const Box box = box_of(film);
  const float most_pull = most_pull_n(film);
  return {index_of(film, box, most_pull).dump(), base64(deflated(bytes_of(film, box, most_pull)))};
}

}  // namespace pastefit
