#include "core/observe/heap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "core/observe/outline.h"

namespace pastefit {

namespace {

constexpr int kDirections = 24;  // in half a turn
// Of pi/24. As constants: the last bits of cos and sin differ between processors.
constexpr double kCosine = 0.99144486137381041, kSine = 0.13052619222005159;

/// Offsets of grid points below a ball, and the depth of its surface below its top (or height above its bottom) there.
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

  /// Calls `meet(here, there, rise)` for every point of a square of n x n points and every point covered by a ball
  /// centred there. Loops over the points of the ball outside, so that rows are vectorised.
  template <class Meet>
  void press(int n, const Meet& meet) const {
    for (const Point& p : points)
      for (int iy = std::max(0, -p.dy); iy < std::min(n, n - p.dy); ++iy) {
        const int row = iy * n, shift = p.dy * n + p.dx, last = std::min(n, n - p.dx);
        for (int ix = std::max(0, -p.dx); ix < last; ++ix) meet(row + ix, row + ix + shift, p.rise);
      }
  }
};

}  // namespace

HeightField::HeightField(const Particles& particles, double mean_radius, double half_width, double x, double y)
    : spacing_(mean_radius / kPointsPerRadius) {
  const int half = static_cast<int>(std::ceil(half_width / spacing_));
  n_ = 2 * half + 1;
  std::vector<double> envelope(static_cast<std::size_t>(n_) * n_, 0.0);
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Motion& grain = particles.motion[i];
    const double r = grain.radius, gx = grain.position.x - x, gy = grain.position.y - y;
    const auto first = [&](double c) { return std::max(0, static_cast<int>(std::ceil((c - r) / spacing_)) + half); };
    const auto last = [&](double c) {
      return std::min(n_ - 1, static_cast<int>(std::floor((c + r) / spacing_)) + half);
    };
    if (!(std::fabs(gx) < half_width + r && std::fabs(gy) < half_width + r)) continue;
    for (int iy = first(gy); iy <= last(gy); ++iy)
      for (int ix = first(gx); ix <= last(gx); ++ix) {
        const double dx = coordinate(ix) - gx, dy = coordinate(iy) - gy;
        const double square = r * r - dx * dx - dy * dy;
        if (square < 0) continue;
        double& h = envelope[iy * n_ + ix];
        h = std::max(h, grain.position.z + std::sqrt(square));
      }
  }

  // Closing: centre of a ball that rests on the envelope, and the lowest height it reaches.
  const Stamp ball(kClosingBall * mean_radius, spacing_);
  std::vector<double> resting(envelope.size(), 0.0);
  ball.press(
      n_, [&](int here, int there, double rise) { resting[here] = std::max(resting[here], envelope[there] - rise); });
  height_.assign(envelope.size(), 1e300);
  ball.press(n_,
             [&](int here, int there, double rise) { height_[here] = std::min(height_[here], resting[there] + rise); });
}

double highest_point(const Particles& particles) {
  double top = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i)
    top = std::max(top, particles.motion[i].position.z + particles.motion[i].radius);
  return top;
}

std::vector<double> rest_measure_of_heap(const Particles& particles) {
  const double n = std::max(particles.count(), 1);
  double height = 0, distance = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Vec3& p = particles.motion[i].position;
    height += p.z / n;
    distance += std::sqrt(p.x * p.x + p.y * p.y) / n;
  }
  return {highest_point(particles), height, distance};
}

namespace {

/// Calls `visit(x, y, height)` for the points of the closed surface on a disc; x and y from its centre.
template <class Visitor>
void each_on_disc(const Particles& particles, double mean_radius, const Disc& disc, const Visitor& visit) {
  const double radius = 0.5 * disc.diameter;
  // The closing ball reaches twice its radius beyond the disc.
  const HeightField field(particles, mean_radius, radius + 2 * kClosingBall * mean_radius, disc.x, disc.y);
  for (int iy = 0; iy < field.points(); ++iy)
    for (int ix = 0; ix < field.points(); ++ix) {
      const double x = field.coordinate(ix), y = field.coordinate(iy);
      if (x * x + y * y <= radius * radius) visit(x, y, field.at(ix, iy));
    }
}

}  // namespace

double mean_height(const Particles& particles, double mean_radius, const Disc& disc) {
  double sum = 0;
  int points = 0;
  each_on_disc(particles, mean_radius, disc, [&](double, double, double height) {
    sum += height;
    ++points;
  });
  return points > 0 ? sum / points : 0;
}

double slope_along_x(const Particles& particles, double mean_radius, const Disc& disc) {
  // The disc is symmetric about its centre: the regression on x alone equals that of the plane.
  double covariance = 0, variance = 0;
  each_on_disc(particles, mean_radius, disc, [&](double x, double, double height) {
    covariance += x * height;
    variance += x * x;
  });
  return variance > 0 ? covariance / variance : 0;
}

namespace {

/// A heap on rays from the vertical through its centre.
class RayedHeap {
 public:
  RayedHeap(const Particles& particles, double mean_radius)
      : middle_(middle_of(particles)),
        half_width_(reach_of_most(particles, middle_) + 2 * kClosingBall * mean_radius),
        field_(particles, mean_radius, half_width_, middle_.x, middle_.y) {}

  const Vec3& middle() const { return middle_; }

  /// Radius of the surface at this height or above, mean over all directions; empty if one direction has none.
  std::optional<double> radius_at(double height) const {
    double sum = 0, cosine = 1, sine = 0;
    for (int d = 0; d < 2 * kDirections; ++d) {
      double r = half_width_;
      while (r > 0 && surface(r * cosine, r * sine) < height) r -= field_.spacing();
      if (r <= 0) return std::nullopt;
      const double here = surface(r * cosine, r * sine);
      const double beyond = surface((r + field_.spacing()) * cosine, (r + field_.spacing()) * sine);
      sum += r + (here > beyond ? field_.spacing() * std::clamp((here - height) / (here - beyond), 0.0, 1.0) : 0.0);
      const double turned = cosine * kCosine - sine * kSine;
      sine = sine * kCosine + cosine * kSine;
      cosine = turned;
    }
    return sum / (2 * kDirections);
  }

 private:
  static Vec3 middle_of(const Particles& particles) {
    Vec3 middle{};
    double volume = 0;
    for (std::int32_t i = 0; i < particles.count(); ++i) {
      const Motion& grain = particles.motion[i];
      const double share = grain.radius * grain.radius * grain.radius;
      middle.x += share * grain.position.x;
      middle.y += share * grain.position.y;
      volume += share;
    }
    return volume > 0 ? Vec3{middle.x / volume, middle.y / volume, 0} : Vec3{};
  }

  /// Distance within which nearly all grains are: single grains roll far.
  static double reach_of_most(const Particles& particles, const Vec3& middle) {
    constexpr double kMost = 0.98;
    std::vector<double> distances;
    for (std::int32_t i = 0; i < particles.count(); ++i) {
      const Vec3& p = particles.motion[i].position;
      distances.push_back(std::sqrt((p.x - middle.x) * (p.x - middle.x) + (p.y - middle.y) * (p.y - middle.y)));
    }
    if (distances.empty()) return 0;
    const auto most =
        distances.begin() + static_cast<std::ptrdiff_t>(kMost * static_cast<double>(distances.size() - 1));
    std::ranges::nth_element(distances, most);
    return std::min(*most, 5.0);
  }

  /// Linear interpolation between the points of the field.
  double surface(double x, double y) const {
    const int half = field_.points() / 2, last = field_.points() - 2;
    const auto place = [&](double c) { return std::clamp(c / field_.spacing() + half, 0.0, last + 1.0); };
    const double px = place(x), py = place(y);
    const int ix = std::min(static_cast<int>(px), last), iy = std::min(static_cast<int>(py), last);
    const double sx = px - ix, sy = py - iy;
    return (1 - sy) * ((1 - sx) * field_.at(ix, iy) + sx * field_.at(ix + 1, iy)) +
           sy * ((1 - sx) * field_.at(ix, iy + 1) + sx * field_.at(ix + 1, iy + 1));
  }

  Vec3 middle_;
  double half_width_;
  HeightField field_;
};

}  // namespace

std::optional<double> flank_angle(const Particles& particles, double mean_radius, double lower, double upper) {
  constexpr int kFewestLevels = 4;
  constexpr double kTip = 5;  // [mean radii] diameter of the disc for the height
  if (particles.count() == 0) return std::nullopt;
  const RayedHeap heap(particles, mean_radius);
  const double height = mean_height(particles, mean_radius, {heap.middle().x, heap.middle().y, kTip * mean_radius});
  const int levels = 1 + static_cast<int>((upper - lower) * height / (0.5 * mean_radius));
  if (levels < kFewestLevels) return std::nullopt;
  double z_sum = 0, r_sum = 0, zz_sum = 0, zr_sum = 0;
  for (int k = 0; k < levels; ++k) {
    const double z = height * (lower + (upper - lower) * k / (levels - 1));
    const auto r = heap.radius_at(z);
    if (!r) return std::nullopt;
    z_sum += z;
    r_sum += *r;
    zz_sum += z * z;
    zr_sum += z * *r;
  }
  const double inwards = (z_sum * r_sum / levels - zr_sum) / (zz_sum - z_sum * z_sum / levels);
  return std::atan2(1.0, std::max(inwards, 0.0));
}

namespace {

Widths widths_of(const Particles& particles, const std::vector<std::int32_t>& body) {
  Widths result;
  if (body.empty()) return result;
  std::array<double, kDirections> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const std::int32_t i : body) {
    const Motion& grain = particles.motion[i];
    double cosine = 1, sine = 0;
    for (int d = 0; d < kDirections; ++d) {
      const double along = grain.position.x * cosine + grain.position.y * sine;
      low[d] = std::min(low[d], along - grain.radius);
      high[d] = std::max(high[d], along + grain.radius);
      const double turned = cosine * kCosine - sine * kSine;
      sine = sine * kCosine + cosine * kSine;
      cosine = turned;
    }
  }
  for (int d = 0; d < kDirections; ++d) {
    const double width = high[d] - low[d];
    result.mean += width / kDirections;
    if (d % (kDirections / 2) == 0) result.orthogonal += 0.5 * width;
  }
  return result;
}

/// Grains as discs in plan, widened by half the largest gap within a body, and sorted into square cells.
class PlanCells {
 public:
  PlanCells(const Particles& particles, double mean_radius)
      : particles_(particles), widening_(0.5 * mean_radius), spacing_(0.5 * mean_radius) {
    double farthest = 0, largest_radius = 0;
    for (std::int32_t i = 0; i < particles.count(); ++i) {
      const Motion& grain = particles.motion[i];
      farthest = std::max({farthest, std::fabs(grain.position.x), std::fabs(grain.position.y)});
      largest_radius = std::max(largest_radius, grain.radius);
    }
    half_ = static_cast<int>(std::ceil((std::min(farthest, 5.0) + 4 * mean_radius) / spacing_));
    side_ = 2 * half_ + 1;
    reach_ = static_cast<int>(std::ceil(2 * (largest_radius + widening_) / spacing_)) + 1;
    cells_.resize(static_cast<std::size_t>(side_) * side_);
    for (std::int32_t i = 0; i < particles.count(); ++i) {
      const Vec3& p = particles.motion[i].position;
      cells_[index(p.y) * static_cast<std::size_t>(side_) + index(p.x)].push_back(i);
    }
  }

  /// Calls `visit(j)` for all grains that may touch grain `i`, including itself.
  template <class Visitor>
  void each_near(std::int32_t i, const Visitor& visit) const {
    const Vec3& p = particles_.motion[i].position;
    const int cx = index(p.x), cy = index(p.y);
    for (int y = std::max(cy - reach_, 0); y <= std::min(cy + reach_, side_ - 1); ++y)
      for (int x = std::max(cx - reach_, 0); x <= std::min(cx + reach_, side_ - 1); ++x)
        for (const std::int32_t j : cells_[y * static_cast<std::size_t>(side_) + x]) visit(j);
  }

  bool touch(std::int32_t i, std::int32_t j) const {
    const Motion &a = particles_.motion[i], &b = particles_.motion[j];
    const double dx = b.position.x - a.position.x, dy = b.position.y - a.position.y;
    const double touch = a.radius + b.radius + 2 * widening_;
    return dx * dx + dy * dy <= touch * touch;
  }

 private:
  int index(double c) const { return std::clamp(static_cast<int>(std::lround(c / spacing_)) + half_, 0, side_ - 1); }

  const Particles& particles_;
  double widening_, spacing_;
  int half_ = 0, side_ = 0, reach_ = 0;  ///< cells
  std::vector<std::vector<std::int32_t>> cells_;
};

/// The grains of the largest body in plan; all grains if no body has half of them.
std::vector<std::int32_t> largest_body(const Particles& particles, double mean_radius) {
  const PlanCells cells(particles, mean_radius);
  std::vector<char> belongs(particles.count(), 0);
  std::vector<std::int32_t> largest, body, front;
  for (std::int32_t seed = 0; seed < particles.count(); ++seed) {
    if (belongs[seed]) continue;
    body.clear();
    front = {seed};
    belongs[seed] = 1;
    while (!front.empty()) {
      const std::int32_t i = front.back();
      front.pop_back();
      body.push_back(i);
      cells.each_near(i, [&](std::int32_t j) {
        if (belongs[j] || !cells.touch(i, j)) return;
        belongs[j] = 1;
        front.push_back(j);
      });
    }
    if (body.size() > largest.size()) largest = body;
  }
  if (2 * largest.size() < belongs.size()) {
    largest.resize(belongs.size());
    std::iota(largest.begin(), largest.end(), 0);
  }
  return largest;
}

}  // namespace

Widths widths(const Particles& particles, double mean_radius) {
  return widths_of(particles, largest_body(particles, mean_radius));
}

}  // namespace pastefit
