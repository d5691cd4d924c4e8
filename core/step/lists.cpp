#include "core/step/lists.h"

#include <algorithm>
#include <cmath>

#include "core/step/state.h"
#include "core/step/state_check.h"

namespace pastefit {

namespace {

constexpr double kStepsPerSelection = 18;
constexpr double kSmallestBound = 0.02;  // of the mean radius
constexpr double kLargestBound = 0.2;
constexpr double kNearlyUsed = 0.6;      // of a displacement bound
constexpr double kRoundedUp = 1 + 1e-6;  // a float is not less than the double
constexpr float kLeastShare = 0.5;       // share of its displacement bound that must fit into a grain's remaining skin

}  // namespace

Lists::Lists(World& world, double skin, ThreadPool& pool, const KernelTable& kernels, StageClock* clock)
    : world_(world), skin_(skin), pool_(pool), kernels_(kernels), clock_(clock) {
  selections_.resize(pool.size());
}

Deepest Lists::update(double dt, double wall_way, double wall_speed) {
  wall_way_ += wall_way;
  const bool walls_due = wall_way_ > wall_bound_;
  if (valid_ && !walls_due && std::find(exceeded_.begin(), exceeded_.end(), true) == exceeded_.end()) return {};
  const double duration = dt * kStepsPerSelection;
  const bool relisted = !valid_ || !goes_on(duration);
  if (relisted) {
    const Timed timed(clock_, StageClock::list);
    list_candidates();
    give_displacement_bounds(duration);
  }
  if (walls_due || relisted) {
    const double radius = world_.reference_radius;
    wall_bound_ = std::clamp(wall_speed * duration, kSmallestBound * radius, kLargestBound * radius);
    wall_way_ = 0;
  }
  const Timed timed(clock_, StageClock::choice);
  note_ways();
  const Deepest deepest = select_pairs();
  select_at_walls(walls_due || relisted);
  std::fill(exceeded_.begin(), exceeded_.end(), false);
  return deepest;
}

void Lists::check_state() const {
  check_pairs(world_, valid_);
  demand(wall_bound_ >= 0 && wall_way_ >= 0 && rounding_ >= 0, "a displacement bound is below nothing");
  for (const DisplacementBound& bound : bounds_.bounds)
    demand(is_in_laboratory(bound.from), "a place is not in the laboratory");
  for (const Listed& listed : listed_) demand(is_in_laboratory(listed.at), "a place is not in the laboratory");
  if (!valid_) return;  // the rest is rebuilt
  const auto grains = static_cast<std::size_t>(world_.particles.count());
  demand(bounds_.bounds.size() == grains && bounds_.own.size() == grains && listed_.size() == grains &&
             exceeded_.size() == world_.pairs.blocks.size(),
         "the lists are of another number of grains");
  for (const DisplacementBound& bound : bounds_.bounds)
    demand(bound.distance <= 0.5 * skin_ * kRoundedUp, "a grain has more room than its skin");
  for (const float own : bounds_.own)
    demand(own >= 0 && own <= kLargestBound * world_.reference_radius * kRoundedUp,
           "a grain would be given more room than any");
  for (const char exceeded : exceeded_) demand(exceeded == 0 || exceeded == 1, "a yes or no is neither");
}

/// Prepares a selection from the present candidates; false if they must be listed anew.
bool Lists::goes_on(double duration) {
  const Timed timed(clock_, StageClock::choice);
  take_along();
  return give_displacement_bounds(duration);
}

/// Blocks in which a grain will soon exceed its bound are selected together with those due, because each of them also
/// costs its neighbour.
void Lists::take_along() {
  const std::vector<Block>& blocks = world_.pairs.blocks;
  const auto nearly = [&](std::int32_t i) {
    const DisplacementBound& bound = bounds_.bounds[i];
    return norm(world_.particles.motion[i].position - vector_of(bound.from)) > kNearlyUsed * bound.distance;
  };
  pool_.each(static_cast<int>(blocks.size()), [&](int b, int) {
    for (std::int32_t i = blocks[b].grains; i < blocks[b].grains_end && !exceeded_[b]; ++i) exceeded_[b] = nearly(i);
  });
}

void Lists::list_candidates() {
  Particles& particles = world_.particles;
  rebuild(particles, world_.domain, world_.pairs, world_.walls.size(), world_.reach(), skin_, kernels_.find_near);
  listed_.resize(particles.count());
  for (std::int32_t i = 0; i < particles.count(); ++i) put_rounded(particles.motion[i].position, listed_[i].at);
  bounds_.bounds.resize(particles.count());
  rounding_ = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    constexpr double kUnit = 1.0 / (1 << 24);  // the relative error of a float
    const double farthest = norm(particles.motion[i].position) + skin_;
    rounding_ = std::max(rounding_, kUnit * farthest);
  }
  bounds_.own.assign(particles.count(), 0);
  exceeded_.assign(world_.pairs.blocks.size(), true);
  valid_ = true;
}

bool Lists::give_displacement_bounds(double duration) {
  const Pairs& pairs = world_.pairs;
  const std::vector<Motion>& motion = world_.particles.motion;
  const double least = kSmallestBound * world_.reference_radius, most = kLargestBound * world_.reference_radius;
  const auto blocks = static_cast<int>(pairs.blocks.size());
  pool_.each(blocks, [&](int b, int) {
    if (!exceeded_[b]) return;
    for (std::int32_t i = pairs.blocks[b].grains; i < pairs.blocks[b].grains_end; ++i) {
      const double bound = std::clamp(norm(world_.particles.velocity[i].linear) * duration, least, most);
      bounds_.own[i] = static_cast<float>(bound);
      put_rounded(motion[i].position, bounds_.bounds[i].from);
      bounds_.bounds[i].distance = static_cast<float>(bound);
    }
  });
  in_two_rounds(pool_, blocks, [&](int b, int) {
    const bool first = exceeded_[b], second = b + 1 < blocks && exceeded_[b + 1];
    if (!first && !second) return;
    const Block& block = pairs.blocks[b];
    block.candidates.each(block.grains, [&](NeighbourList::Pair pair, std::int32_t i) {
      const std::int32_t j = pair.grain();
      const auto raise_bound = [&](std::int32_t grain, std::int32_t other) {
        bounds_.bounds[grain].distance = std::max(bounds_.bounds[grain].distance, bounds_.own[other]);
      };
      if (first) raise_bound(i, j);
      if (j < block.grains_end ? first : second) raise_bound(j, i);
    });
  });
  // Each grain of a candidate pair may use half of the skin.
  std::vector<char> enough(blocks, true);
  pool_.each(blocks, [&](int b, int) {
    if (!exceeded_[b]) return;
    for (std::int32_t i = pairs.blocks[b].grains; i < pairs.blocks[b].grains_end; ++i) {
      const double used = norm(motion[i].position - vector_of(listed_[i].at)) + 2 * rounding_;
      const auto left = static_cast<float>(0.5 * skin_ - used);
      float& distance = bounds_.bounds[i].distance;
      if (!(left >= kLeastShare * distance)) enough[b] = false;
      distance = std::min(distance, left);
    }
  });
  return std::find(enough.begin(), enough.end(), false) == enough.end();
}

/// A grain of a block that keeps its bounds has already moved, and may move back.
void Lists::note_ways() {
  bounds_.way.resize(bounds_.bounds.size());
  pool_.each(static_cast<int>(world_.pairs.blocks.size()), [&](int b, int) {
    for (std::int32_t i = world_.pairs.blocks[b].grains; i < world_.pairs.blocks[b].grains_end; ++i) {
      const DisplacementBound& bound = bounds_.bounds[i];
      const double moved = norm(world_.particles.motion[i].position - vector_of(bound.from));
      bounds_.way[i] = static_cast<float>((bound.distance + moved) * kRoundedUp);
    }
  });
}

Deepest Lists::select_pairs() {
  std::vector<Block>& blocks = world_.pairs.blocks;
  std::vector<Deepest> deepest(blocks.size());
  pool_.each(static_cast<int>(blocks.size()), [&](int b, int member) {
    const bool next_exceeded = b + 1 < static_cast<int>(blocks.size()) && exceeded_[b + 1];
    if (!exceeded_[b] && !next_exceeded) return;
    deepest[b] = pastefit::select_pairs(world_.particles, world_.domain, blocks[b], world_.particles.count() + b,
                                        selections_[member], world_.reach(), bounds_, kernels_.find_nearness);
  });
  return *std::max_element(deepest.begin(), deepest.end(),
                           [](const Deepest& a, const Deepest& b) { return a.overlap < b.overlap; });
}

void Lists::select_at_walls(bool everywhere) {
  std::vector<Block>& blocks = world_.pairs.blocks;
  pool_.each(static_cast<int>(blocks.size()), [&](int b, int member) {
    if (!everywhere && !exceeded_[b]) return;
    for (std::size_t w = 0; w < world_.walls.size(); ++w)
      select_at_wall(world_.particles, world_.walls[w], blocks[b], blocks[b].walls[w], selections_[member],
                     world_.reach(), bounds_, wall_bound_);
  });
}

}  // namespace pastefit
