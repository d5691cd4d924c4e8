#include "core/observe/heap.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

namespace {

constexpr double kPointsPerRadius = 4;
constexpr double kClosingBall = 2;  // radius of the closing ball over the mean grain radius
constexpr double kPlateauShare = 0.8;

/// Offsets of grid points under a ball, and how far its surface lies below its top (or above its bottom) there.
struct Stamp {
  struct Point {
    int dx, dy;
    double rise;
  };
  std::vector<Point> points;

  Stamp(double radius, double spacing) {
    const int reach = static_cast<int>(radius / spacing);
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const double square = (dx * dx + dy * dy) * spacing * spacing;
        if (square <= radius * radius) points.push_back({dx, dy, radius - std::sqrt(radius * radius - square)});
      }
  }
};

}  // namespace

HeightField::HeightField(const Particles& particles, double mean_radius, double half_width)
    : spacing_(mean_radius / kPointsPerRadius) {
  const int half = static_cast<int>(std::ceil(half_width / spacing_));
  n_ = 2 * half + 1;
  std::vector<double> envelope(static_cast<std::size_t>(n_) * n_, 0.0);
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Motion& grain = particles.motion[i];
    const double r = grain.radius;
    const auto first = [&](double c) { return std::max(0, static_cast<int>(std::ceil((c - r) / spacing_)) + half); };
    const auto last = [&](double c) {
      return std::min(n_ - 1, static_cast<int>(std::floor((c + r) / spacing_)) + half);
    };
    if (!(std::fabs(grain.position.x) < half_width + r && std::fabs(grain.position.y) < half_width + r)) continue;
    for (int iy = first(grain.position.y); iy <= last(grain.position.y); ++iy)
      for (int ix = first(grain.position.x); ix <= last(grain.position.x); ++ix) {
        const double dx = coordinate(ix) - grain.position.x, dy = coordinate(iy) - grain.position.y;
        const double square = r * r - dx * dx - dy * dy;
        if (square < 0) continue;
        double& h = envelope[iy * n_ + ix];
        h = std::max(h, grain.position.z + std::sqrt(square));
      }
  }

  // Closing: where a ball resting on the envelope has its centre, and how deep it reaches there.
  const Stamp ball(kClosingBall * mean_radius, spacing_);
  const auto inside = [&](int i) { return i >= 0 && i < n_; };
  std::vector<double> resting(envelope.size(), 0.0);
  for (int iy = 0; iy < n_; ++iy)
    for (int ix = 0; ix < n_; ++ix) {
      double bottom = 0;
      for (const auto& p : ball.points)
        if (inside(ix + p.dx) && inside(iy + p.dy))
          bottom = std::max(bottom, envelope[(iy + p.dy) * n_ + ix + p.dx] - p.rise);
      resting[iy * n_ + ix] = bottom;
    }
  height_.assign(envelope.size(), 0.0);
  for (int iy = 0; iy < n_; ++iy)
    for (int ix = 0; ix < n_; ++ix) {
      double lowest = 1e300;
      for (const auto& p : ball.points)
        if (inside(ix + p.dx) && inside(iy + p.dy))
          lowest = std::min(lowest, resting[(iy + p.dy) * n_ + ix + p.dx] + p.rise);
      height_[iy * n_ + ix] = lowest;
    }
}

double highest_point(const Particles& particles) {
  double top = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i)
    top = std::max(top, particles.motion[i].position.z + particles.motion[i].radius);
  return top;
}

double height_at_axis(const Particles& particles, double mean_radius, double probe_diameter) {
  const double radius = 0.5 * probe_diameter;
  // The closing ball looks twice its radius beyond the disc.
  const HeightField field(particles, mean_radius, radius + 2 * kClosingBall * mean_radius);
  double sum = 0;
  int points = 0;
  for (int iy = 0; iy < field.points(); ++iy)
    for (int ix = 0; ix < field.points(); ++ix) {
      const double x = field.coordinate(ix), y = field.coordinate(iy);
      if (x * x + y * y > radius * radius) continue;
      sum += field.at(ix, iy);
      ++points;
    }
  return points > 0 ? sum / points : 0;
}

double spread_diameter(const Particles& particles, double mean_radius) {
  // Grains as discs in plan, widened by half the gap that may separate grains of one body; flood from the axis.
  const double widening = 0.5 * mean_radius, spacing = 0.5 * mean_radius;
  double farthest = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Vec3& p = particles.motion[i].position;
    farthest = std::max({farthest, std::fabs(p.x), std::fabs(p.y)});
  }
  const int half = static_cast<int>(std::ceil((std::min(farthest, 5.0) + 4 * mean_radius) / spacing));
  const int n = 2 * half + 1;
  std::vector<std::vector<std::int32_t>> at(static_cast<std::size_t>(n) * n);
  const auto index = [&](double c) { return std::clamp(static_cast<int>(std::lround(c / spacing)) + half, 0, n - 1); };
  std::int32_t seed = -1;
  double nearest = 1e300;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Vec3& p = particles.motion[i].position;
    at[index(p.y) * static_cast<std::size_t>(n) + index(p.x)].push_back(i);
    const double square = p.x * p.x + p.y * p.y;
    if (square < nearest) {
      nearest = square;
      seed = i;
    }
  }
  if (seed < 0) return 0;
  double largest_radius = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i)
    largest_radius = std::max(largest_radius, particles.motion[i].radius);
  const int reach = static_cast<int>(std::ceil(2 * (largest_radius + widening) / spacing)) + 1;

  std::vector<char> belongs(particles.count(), 0);
  std::vector<std::int32_t> front{seed};
  belongs[seed] = 1;
  double low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  while (!front.empty()) {
    const std::int32_t i = front.back();
    front.pop_back();
    const Motion& a = particles.motion[i];
    low_x = std::min(low_x, a.position.x - a.radius);
    high_x = std::max(high_x, a.position.x + a.radius);
    low_y = std::min(low_y, a.position.y - a.radius);
    high_y = std::max(high_y, a.position.y + a.radius);
    const int cx = index(a.position.x), cy = index(a.position.y);
    for (int y = std::max(cy - reach, 0); y <= std::min(cy + reach, n - 1); ++y)
      for (int x = std::max(cx - reach, 0); x <= std::min(cx + reach, n - 1); ++x)
        for (const std::int32_t j : at[y * static_cast<std::size_t>(n) + x]) {
          if (belongs[j]) continue;
          const Motion& b = particles.motion[j];
          const double dx = b.position.x - a.position.x, dy = b.position.y - a.position.y;
          const double touch = a.radius + b.radius + 2 * widening;
          if (dx * dx + dy * dy > touch * touch) continue;
          belongs[j] = 1;
          front.push_back(j);
        }
  }
  return 0.5 * ((high_x - low_x) + (high_y - low_y));
}

Plateau plateau(const Particles& particles, double mean_radius, double probe_diameter, double half_width) {
  const HeightField field(particles, mean_radius, half_width);
  const int n = field.points(), middle = n / 2;
  const int strip = static_cast<int>(0.5 * probe_diameter / field.spacing());
  std::vector<double> profile(n, 0.0);
  for (int ix = 0; ix < n; ++ix) {
    for (int iy = middle - strip; iy <= middle + strip; ++iy) profile[ix] += field.at(ix, iy);
    profile[ix] /= 2 * strip + 1;
  }
  double reference = 0;
  for (int ix = middle - strip; ix <= middle + strip; ++ix) reference += profile[ix] / (2 * strip + 1);
  const double edge = kPlateauShare * reference;
  int left = middle, right = middle;
  while (left > 0 && profile[left - 1] >= edge) --left;
  while (right < n - 1 && profile[right + 1] >= edge) ++right;

  double mean_x = 0, mean_z = 0;
  const double count = right - left + 1;
  for (int ix = left; ix <= right; ++ix) {
    mean_x += field.coordinate(ix) / count;
    mean_z += profile[ix] / count;
  }
  double covariance = 0, variance = 0;
  for (int ix = left; ix <= right; ++ix) {
    const double dx = field.coordinate(ix) - mean_x;
    covariance += dx * (profile[ix] - mean_z);
    variance += dx * dx;
  }
  Plateau result;
  result.width = (right - left) * field.spacing();
  result.sag = variance > 0 ? -covariance / variance * result.width : 0;
  return result;
}

}  // namespace pastefit
