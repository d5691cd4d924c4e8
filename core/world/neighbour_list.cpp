#include "core/world/neighbour_list.h"

#include <numeric>

#include "core/laws/pack.h"

namespace pastefit {

void NeighbourList::clear() {
  ends_.clear();
  pairs_.clear();
}

bool NeighbourList::is_of(std::int32_t grains) const {
  if (std::ssize(ends_) != grains || !std::ranges::is_sorted(ends_)) return false;
  return ends_.empty() ? pairs_.empty() : ends_.front() >= 0 && ends_.back() == std::ssize(pairs_);
}

Vicinity::Vicinity(const Particles& particles, const Domain& domain, double farthest, double skin)
    : domain_(domain), gap_(2 * farthest) {
  constexpr double kRounding = 1e-6;  // several times that of differences and squares in single precision
  const std::int32_t n = particles.count();
  Vec3 low = particles.motion[0].position, high = low;
  double largest = 0;
  for (std::int32_t i = 0; i < n; ++i) {
    const Vec3& p = particles.motion[i].position;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    largest = std::max(largest, particles.motion[i].radius);
  }
  const Vec3 middle = 0.5 * (low + high), span = high - low;
  skin_ = skin + kRounding * (std::max({span.x, span.y, span.z}) + (2 + farthest) * largest + skin);
  for (std::vector<float>& column : all_) column.resize(n);
  for (std::int32_t i = 0; i < n; ++i) {
    const Motion& grain = particles.motion[i];
    const Vec3 place = grain.position - middle;
    all_[x][i] = static_cast<float>(place.x);
    all_[y][i] = static_cast<float>(place.y);
    all_[z][i] = static_cast<float>(place.z);
    all_[radius][i] = static_cast<float>(grain.radius);
  }
}

void Vicinity::gather(std::int32_t begin, std::int32_t end) {
  const std::int32_t count = count_ + end - begin;
  const auto room = static_cast<std::size_t>(count) + kLanes;  // the last lanes are read, not looked at
  if (grain_.size() < room) {
    for (std::vector<float>& column : gathered_) column.resize(2 * room, 1.0F);
    grain_.resize(2 * room);
    near_.resize(2 * room);
  }
  for (int c = 0; c < columns; ++c)
    std::copy(all_[c].begin() + begin, all_[c].begin() + end, gathered_[c].begin() + count_);
  std::iota(grain_.begin() + count_, grain_.begin() + count, begin);
  count_ = count;
}

/// No jumps: whether a pair is near is as good as random.
void Vicinity::find_lanes(std::int32_t i, std::int32_t from) {
  using Four = Singles<kLanes>;
  const auto four = [&](Column column, std::int32_t at) { return Four(_mm_loadu_ps(gathered_[column].data() + at)); };
  const BasicVec3<Four> place{all_[x][i], all_[y][i], all_[z][i]};
  const Four own(all_[radius][i]), gap = Four(gap_) * own, skin(skin_);
  const std::int32_t* const grain = grain_.data();
  std::int32_t *const near = near_.data(), found = 0;
  for (std::int32_t at = from; at < count_; at += kLanes) {
    BasicVec3<Four> way{four(x, at) - place.x, four(y, at) - place.y, four(z, at) - place.z};
    if (domain_.repeats()) way = domain_.shortest(way);
    const Four other = four(radius, at), touch = own + other;
    const Four range = touch + gap * other / touch + skin;
    const Four square = way.x * way.x + way.y * way.y + way.z * way.z;
    int within = _mm_movemask_ps(reinterpret_cast<__m128>(square < range * range));
    within &= (1 << std::min(kLanes, count_ - at)) - 1;
    for (int lane = 0; lane < kLanes; ++lane) {
      near[found] = grain[at + lane];
      found += within >> lane & 1;
    }
  }
  found_ = found;
}

}  // namespace pastefit
