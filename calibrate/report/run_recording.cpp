#include "calibrate/report/run_recording.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <variant>

#include "calibrate/base/text.h"
#include "calibrate/report/links.h"
#include "calibrate/store/store.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

bool is_filling(const RecordedFrame& frame) {
  return frame.phase.starts_with("fill.");
}

RecordedFrame frame_of(const World& world) {
  const auto grains = static_cast<std::size_t>(world.particles.count());
  RecordedFrame frame;
  frame.centres_m.resize(grains);
  frame.speeds_m_s.resize(grains);
  frame.coordination.resize(grains);
  frame.pulls_n.resize(grains);
  const auto links = links_of(world);
  const auto touching = coordination_of(links, world.particles.count());
  const auto pulls = pulls_of(links, world.particles.count());
  for (std::size_t i = 0; i < grains; ++i) {
    const auto identity = static_cast<std::size_t>(world.particles.identity[i]);
    const Motion& motion = world.particles.motion[i];
    frame.centres_m[identity] = motion.position;
    frame.speeds_m_s[identity] = static_cast<float>(norm(world.particles.velocity[i].linear));
    frame.coordination[identity] = touching[i];
    frame.pulls_n[identity] = pulls[i];
  }
  frame.walls = world.walls;
  return frame;
}

/// Number of pictures of so many grains that a page can contain.
double pictures_for(std::size_t grains) {
  constexpr double kMost = 140, kLeast = 36, kGrainsInAll = 260'000;
  return std::clamp(kGrainsInAll / static_cast<double>(std::max<std::size_t>(grains, 1)), kLeast, kMost);
}

/// Keeps pictures at least `interval_s` apart, and the last one.
void thin(RecordingPart& part, double interval_s) {
  double next_s = -std::numeric_limits<double>::infinity();
  std::vector<RecordedFrame> kept;
  for (std::size_t i = 0; i < part.frames.size(); ++i) {
    RecordedFrame& frame = part.frames[i];
    if (frame.time_s < next_s && i + 1 < part.frames.size()) continue;
    next_s = frame.time_s + interval_s - 0.5 * RunRecorder::kInterval;
    kept.push_back(std::move(frame));
  }
  part.frames = std::move(kept);
}

/// True for visible growth; the adjustment of a column to its mould is smaller.
bool have_grown(const RecordingPart& part, const Particles& grains) {
  constexpr double kSeen = 0.03;
  const double before = part.radii_m[static_cast<std::size_t>(grains.identity[0])];
  return std::fabs(grains.motion[0].radius - before) > kSeen * before;
}

std::string key_of_test(const Test& test) {
  return evaluation_key("", test);
}

/// Key of the test with this material, independent of the packing.
std::string name_of_material(Test test) {
  specimen_of(test).packing_seed = 0;
  return key_of_test(test);
}

}  // namespace

std::size_t RunRecording::grains() const {
  std::size_t most = 0;
  for (const RecordingPart& part : parts) most = std::max(most, part.radii_m.size());
  return most;
}

std::size_t RunRecording::frames() const {
  std::size_t sum = 0;
  for (const RecordingPart& part : parts) sum += part.frames.size();
  return sum;
}

void RunRecorder::add(const Snapshot& snapshot) {
  if (!snapshot.world || snapshot.world->particles.count() == 0) return;
  const World& world = *snapshot.world;
  const auto grains = static_cast<std::size_t>(world.particles.count());
  const bool others = film_.parts.empty() || snapshot.time_s < last_s_ || snapshot.drop != drop_ ||
                      film_.parts.back().radii_m.size() != grains;
  if (others) {
    begun_s_ = film_.parts.empty() ? 0 : film_.parts.back().frames.back().time_s;
    first_s_ = snapshot.drop > 0 ? snapshot.time_s : 0;  // a further drop continues the heap's clock
  }
  if (others || have_grown(film_.parts.back(), world.particles)) {
    RecordingPart part;
    part.radii_m.resize(grains);
    for (std::size_t i = 0; i < grains; ++i)
      part.radii_m[static_cast<std::size_t>(world.particles.identity[i])] = world.particles.motion[i].radius;
    film_.parts.push_back(std::move(part));
  }
  last_s_ = snapshot.time_s;
  drop_ = snapshot.drop;
  RecordedFrame frame = frame_of(world);
  frame.time_s = begun_s_ + snapshot.time_s - first_s_;
  frame.phase = snapshot.phase;
  if (snapshot.drop > 0) frame.phase += ", heap turned half round";
  film_.parts.back().frames.push_back(std::move(frame));
}

RunRecording RunRecorder::film() && {
  double filling_s = 0, test_s = 0;
  for (const RecordingPart& part : film_.parts) {
    const double length_s = part.frames.back().time_s - part.frames.front().time_s;
    (is_filling(part.frames.front()) ? filling_s : test_s) += length_s;
  }
  const double count = pictures_for(film_.grains());
  const bool both = filling_s > 0 && test_s > 0;
  for (RecordingPart& part : film_.parts) {
    const bool filling = is_filling(part.frames.front());
    const double share = !both ? 1 : filling ? 0.25 : 0.75;
    thin(part, (filling ? filling_s : test_s) / (share * count));
  }
  return std::move(film_);
}

void SeenSimulation::see(const Test& test, const Snapshot& snapshot) {
  if (snapshot.world)
    if (auto outline = outline_at(test, snapshot))
      seen.outlines.insert_or_assign(std::string(outline->name), std::move(outline->outline));
  if (film) film->add(snapshot);
}

void SeenSimulation::end(const Outcome& outcome) {
  failure = outcome.failure;
  seen.readings = outcome.readings;
  seen.curve = outcome.curve;
  ended = true;
}

RunObserver::Watch RunRecordings::begin(const Test& test) {
  constexpr std::size_t kMostFilms = 8;
  const std::lock_guard lock(mutex_);
  std::unique_ptr<SeenSimulation>& look = recordings_[key_of_test(test)];
  look = std::make_unique<SeenSimulation>();
  look->seen.packing = specimen_of(test).packing_seed;
  if (filmed_.size() < kMostFilms && filmed_.insert(name_of_material(test)).second) look->film.emplace();
  return [test, look = look.get()](const Snapshot& snapshot) { look->see(test, snapshot); };
}

void RunRecordings::end(const Test& test, const Outcome& outcome) {
  const std::lock_guard lock(mutex_);
  recordings_.at(key_of_test(test))->end(outcome);
}

std::optional<SeenSimulation> RunRecordings::take(const Test& test) {
  const std::lock_guard lock(mutex_);
  const auto found = recordings_.find(key_of_test(test));
  if (found == recordings_.end() || !found->second->ended) return std::nullopt;
  const auto look = std::move(found->second);
  recordings_.erase(found);
  return std::move(*look);
}

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
  std::array<std::vector<std::uint8_t>, 3> states;  // speed, coordination, tension
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
  auto& [speeds, touching, pulls] = out.states;
  for (const float speed : frame.speeds_m_s) speeds.push_back(code_of_speed(speed));
  touching = frame.coordination;
  for (const float pull : frame.pulls_n)
    pulls.push_back(static_cast<std::uint8_t>(most_pull > 0 ? std::lround(255 * pull / most_pull) : 0));
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
  for (std::size_t c = 0; c < 3; ++c)
    for (const auto byte : change(now.states[c], before.states[c])) bytes += static_cast<char>(byte);
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

ordered_json json_of(const Wall& wall) {
  ordered_json out{{"name", wall.name}};
  if (const auto* plane = std::get_if<Plane>(&wall.shape)) {
    out["shape"] = "plane";
    out["point_m"] = places_of(plane->point);
    out["normal"] = places_of(plane->normal);
  } else if (const auto* plate = std::get_if<Plate>(&wall.shape)) {
    out["shape"] = "plate";
    out["centre_m"] = places_of(plate->centre);
    out["along"] = places_of(plate->along);
    out["across"] = places_of(plate->across);
    out["half_m"] = {plate->half_length, plate->half_width};
  } else if (const auto* shell = std::get_if<Shell>(&wall.shape)) {
    out["shape"] = "shell";
    out["base_m"] = places_of(shell->base);
    out["radii_m"] = {shell->base_radius, shell->top_radius};
    out["height_m"] = shell->height;
  } else if (const auto* ribs = std::get_if<Ribs>(&wall.shape)) {
    out["shape"] = "ribs";
    out["base_m"] = places_of(ribs->base);
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
      for (const Wall& wall : frame.walls) walls.push_back(json_of(wall));
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
