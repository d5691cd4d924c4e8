#include "calibrate/report/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibrate/report/links.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

bool is_filling(const FilmFrame& frame) {
  return frame.phase.starts_with("fill.");
}

FilmFrame frame_of(const World& world) {
  const auto grains = static_cast<std::size_t>(world.particles.count());
  FilmFrame frame;
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

/// How many pictures of so many grains a page can hold.
double pictures_for(std::size_t grains) {
  constexpr double kMost = 140, kLeast = 36, kGrainsInAll = 260'000;
  return std::clamp(kGrainsInAll / static_cast<double>(std::max<std::size_t>(grains, 1)), kLeast, kMost);
}

/// The pictures of a reel at least `interval_s` apart, and its last one.
void thin(Reel& reel, double interval_s) {
  double next_s = -std::numeric_limits<double>::infinity();
  std::vector<FilmFrame> kept;
  for (std::size_t i = 0; i < reel.frames.size(); ++i) {
    FilmFrame& frame = reel.frames[i];
    if (frame.time_s < next_s && i + 1 < reel.frames.size()) continue;
    next_s = frame.time_s + interval_s - 0.5 * FilmRecorder::kInterval;
    kept.push_back(std::move(frame));
  }
  reel.frames = std::move(kept);
}

}  // namespace

std::size_t Film::grains() const {
  std::size_t most = 0;
  for (const Reel& reel : reels) most = std::max(most, reel.radii_m.size());
  return most;
}

std::size_t Film::frames() const {
  std::size_t sum = 0;
  for (const Reel& reel : reels) sum += reel.frames.size();
  return sum;
}

void FilmRecorder::add(const Moment& moment) {
  if (!moment.world || moment.world->particles.count() == 0) return;
  const World& world = *moment.world;
  const auto grains = static_cast<std::size_t>(world.particles.count());
  const bool anew = film_.reels.empty() || moment.time_s < last_s_ || moment.drop != drop_ ||
                    film_.reels.back().radii_m.size() != grains;
  if (anew) {
    begun_s_ = film_.reels.empty() ? 0 : film_.reels.back().frames.back().time_s;
    first_s_ = moment.drop > 0 ? moment.time_s : 0;  // the drop goes on with the clock of the heap
    Reel reel;
    reel.radii_m.resize(grains);
    for (std::size_t i = 0; i < grains; ++i)
      reel.radii_m[static_cast<std::size_t>(world.particles.identity[i])] = world.particles.motion[i].radius;
    film_.reels.push_back(std::move(reel));
  }
  last_s_ = moment.time_s;
  drop_ = moment.drop;
  FilmFrame frame = frame_of(world);
  frame.time_s = begun_s_ + moment.time_s - first_s_;
  frame.phase = moment.phase;
  if (moment.drop > 0) frame.phase += ", heap turned half round";
  film_.reels.back().frames.push_back(std::move(frame));
}

Film FilmRecorder::film() && {
  double filling_s = 0, test_s = 0;
  for (const Reel& reel : film_.reels) {
    const double length_s = reel.frames.back().time_s - reel.frames.front().time_s;
    (is_filling(reel.frames.front()) ? filling_s : test_s) += length_s;
  }
  const double count = pictures_for(film_.grains());
  const double share_of_filling = filling_s > 0 && test_s > 0 ? 0.25 : 1;
  for (Reel& reel : film_.reels) {
    const bool filling = is_filling(reel.frames.front());
    const double share = filling ? share_of_filling : test_s > 0 && filling_s > 0 ? 0.75 : 1;
    thin(reel, (filling ? filling_s : test_s) / (share * count));
  }
  return std::move(film_);
}

}  // namespace pastefit
