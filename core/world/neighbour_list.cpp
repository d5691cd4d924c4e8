#include "core/world/neighbour_list.h"

#include <algorithm>
#include <numeric>

namespace pastefit {

void NeighbourList::clear() {
  ends_.clear();
  pairs_.clear();
}

bool NeighbourList::is_of(std::int32_t grains) const {
  if (std::ssize(ends_) != grains || !std::ranges::is_sorted(ends_)) return false;
  return ends_.empty() ? pairs_.empty() : ends_.front() >= 0 && ends_.back() == std::ssize(pairs_);
}

/// Writes 16 entries for a grain at once; the next grain overwrites the surplus. Mostly no inner loop.
void NeighbourList::first_grains(std::int32_t first, std::vector<std::int32_t>& grains) const {
  constexpr std::size_t kAtOnce = 16;
  if (grains.size() < pairs_.size() + kAtOnce) grains.resize(pairs_.size() + pairs_.size() / 8 + kAtOnce);
  std::int32_t begin = 0;
  for (const std::int32_t end : ends_) {
    for (std::int32_t k = begin; k < end; k += kAtOnce) std::fill_n(grains.begin() + k, kAtOnce, first);
    begin = end;
    ++first;
  }
}

Vicinity::Vicinity(const Particles& particles, const Domain& domain, double farthest, double skin, FindNear find_near)
    : domain_(domain), gap_(2 * farthest), find_near_(find_near) {
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
  const auto room = static_cast<std::size_t>(count) + SphereColumns::kBeyond;
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

VicinityTask Vicinity::task(std::int32_t i, std::int32_t from) {
  return {{gathered_[x].data(), gathered_[y].data(), gathered_[z].data(), gathered_[radius].data(), grain_.data()},
          from,
          count_,
          {all_[x][i], all_[y][i], all_[z][i]},
          all_[radius][i],
          static_cast<float>(gap_),
          static_cast<float>(skin_),
          domain_,
          near_.data()};
}

}  // namespace pastefit
