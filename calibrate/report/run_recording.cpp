#include "calibrate/report/run_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
  for (const Wall& wall : world.walls) frame.walls.push_back({wall.name, wall.shape});
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
  const double share_of_filling = filling_s > 0 && test_s > 0 ? 0.25 : 1;
  for (RecordingPart& part : film_.parts) {
    const bool filling = is_filling(part.frames.front());
    const double share = filling ? share_of_filling : test_s > 0 && filling_s > 0 ? 0.75 : 1;
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

}  // namespace pastefit
