#include "core/observe/outline.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

namespace {

constexpr double kPlateauShare = 0.8;

}  // namespace

double Outline::at(double x_m) const {
  const double place = (x_m - first_x_m) / spacing_m;
  if (!(place >= 0 && place <= static_cast<double>(height_m.size()) - 1)) return 0;
  const auto k = std::min(static_cast<std::size_t>(place), height_m.size() - 1);
  const double share = place - static_cast<double>(k);
  return share == 0 ? height_m[k] : (1 - share) * height_m[k] + share * height_m[k + 1];
}

Outline outline(const Particles& particles, double mean_radius) {
  Outline result;
  result.spacing_m = mean_radius / kPointsPerRadius;
  const double spacing = result.spacing_m;
  int first = 0, last = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Motion& grain = particles.motion[i];
    first = std::min(first, static_cast<int>(std::floor((grain.position.x - grain.radius) / spacing)));
    last = std::max(last, static_cast<int>(std::ceil((grain.position.x + grain.radius) / spacing)));
  }
  result.first_x_m = first * spacing;
  const int points = last - first + 1;
  std::vector<double> envelope(points, 0.0);
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Motion& grain = particles.motion[i];
    const int from = static_cast<int>(std::ceil((grain.position.x - grain.radius) / spacing)) - first;
    const int to = static_cast<int>(std::floor((grain.position.x + grain.radius) / spacing)) - first;
    for (int k = from; k <= to; ++k) {
      const double dx = (k + first) * spacing - grain.position.x;
      const double square = grain.radius * grain.radius - dx * dx;
      if (square >= 0) envelope[k] = std::max(envelope[k], grain.position.z + std::sqrt(square));
    }
  }
  const double ball = kClosingBall * mean_radius;
  const int reach = static_cast<int>(ball / spacing);
  const auto rise = [&](int d) { return ball - std::sqrt(ball * ball - d * d * spacing * spacing); };
  std::vector<double> resting(points, 0.0);
  result.height_m.assign(points, 0.0);
  for (int k = 0; k < points; ++k)
    for (int d = std::max(-reach, -k); d <= std::min(reach, points - 1 - k); ++d)
      resting[k] = std::max(resting[k], envelope[k + d] - rise(d));
  for (int k = 0; k < points; ++k) {
    double lowest = 1e300;
    for (int d = std::max(-reach, -k); d <= std::min(reach, points - 1 - k); ++d)
      lowest = std::min(lowest, resting[k + d] + rise(d));
    result.height_m[k] = lowest;
  }
  return result;
}

double plateau_width(const Outline& outline) {
  const double edge = kPlateauShare * outline.at(0), spacing = outline.spacing_m;
  if (!(edge > 0)) return 0;
  double left = 0, right = 0;
  while (outline.at(left - spacing) >= edge) left -= spacing;
  while (outline.at(right + spacing) >= edge) right += spacing;
  return right - left;
}

double rms_difference(const Outline& outline, const std::vector<OutlinePoint>& measured) {
  constexpr int kPoints = 500;  // a millimetre on a wide heap; both curves are linear in between
  const double from = measured.front()[0], width = measured.back()[0] - from;
  double squares = 0;
  std::size_t k = 0;
  for (int n = 0; n < kPoints; ++n) {
    const double x = from + width * (n + 0.5) / kPoints;
    while (k + 2 < measured.size() && measured[k + 1][0] <= x) ++k;
    const OutlinePoint &a = measured[k], &b = measured[k + 1];
    const double z = a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
    const double difference = outline.at(x) - z;
    squares += difference * difference / kPoints;
  }
  return std::sqrt(squares);
}

}  // namespace pastefit
