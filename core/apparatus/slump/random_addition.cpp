#include "core/apparatus/slump/random_addition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/apparatus/specimen.h"
#include "core/random.h"

namespace pastefit {

namespace {

constexpr int kTries = 2000;  // failed tries before spheres may be placed higher

/// Spheres by the cell of a cubic grid that contains their centres. Cells are as wide as the largest sphere, so that
/// touching spheres are in the same cell or in neighbouring ones.
class Placed {
 public:
  Placed(double half_width, double largest_radius)
      : half_width_(half_width), cell_(2 * largest_radius), across_(static_cast<int>(2 * half_width / cell_) + 1) {}

  bool meets(const Vec3& centre, double radius) const {
    const auto [cx, cy, cz] = cell_of(centre);
    for (int z = std::max(0, cz - 1); z <= cz + 1; ++z)
      for (int y = std::max(0, cy - 1); y <= std::min(across_ - 1, cy + 1); ++y)
        for (int x = std::max(0, cx - 1); x <= std::min(across_ - 1, cx + 1); ++x)
          if (meets_in(number_of(x, y, z), centre, radius)) return true;
    return false;
  }

  void add(const Vec3& centre, double radius) {
    const auto [x, y, z] = cell_of(centre);
    const std::size_t cell = number_of(x, y, z);
    if (cell >= spheres_.size()) spheres_.resize(cell + 1);
    spheres_[cell].push_back({centre, radius});
  }

 private:
  struct Sphere {
    Vec3 centre;
    double radius;
  };

  std::array<int, 3> cell_of(const Vec3& p) const {
    return {static_cast<int>((p.x + half_width_) / cell_), static_cast<int>((p.y + half_width_) / cell_),
            static_cast<int>(p.z / cell_)};
  }
  std::size_t number_of(int x, int y, int z) const { return (static_cast<std::size_t>(z) * across_ + y) * across_ + x; }
  bool meets_in(std::size_t cell, const Vec3& centre, double radius) const {
    if (cell >= spheres_.size()) return false;
    return std::any_of(spheres_[cell].begin(), spheres_[cell].end(), [&](const Sphere& other) {
      const Vec3 apart = other.centre - centre;
      const double touching = other.radius + radius;
      return dot(apart, apart) < touching * touching;
    });
  }

  double half_width_, cell_;
  int across_;  ///< cells along x and y
  std::vector<std::vector<Sphere>> spheres_;
};

/// Height to which this volume fills mould and hopper.
double filled_to(const Mould& mould, double volume) {
  const double above = std::max(0.0, volume - volume_m3(mould));
  return mould.height_m + above / (std::numbers::pi * mould.top_radius_m * mould.top_radius_m);
}

}  // namespace

double inner_radius(const Mould& mould, double z) {
  const double share = std::min(z / mould.height_m, 1.0);
  return mould.base_radius_m + share * (mould.top_radius_m - mould.base_radius_m);
}

std::vector<Vec3> random_addition(const Mould& mould, const std::vector<double>& radii, double solid_fraction,
                                  std::uint64_t seed) {
  std::vector<Vec3> centres;
  if (radii.empty()) return centres;
  double volume = 0;
  for (const double radius : radii) volume += sphere_volume_m3(radius);
  double top = filled_to(mould, volume / solid_fraction);
  const double half_width = wider_radius_m(mould);
  const double slope = (mould.base_radius_m - mould.top_radius_m) / mould.height_m;
  const double along_slope = std::sqrt(1 + slope * slope);  // slant length of the side over its height
  Placed placed(half_width, *std::max_element(radii.begin(), radii.end()));
  const RandomStream place(seed, "random-addition");
  std::uint64_t draw = 0;
  for (const double radius : radii) {
    for (int tries = 1;; ++tries) {
      if (tries % kTries == 0) top += radius;
      const Vec3 centre{place.uniform(draw, -half_width, half_width), place.uniform(draw + 1, -half_width, half_width),
                        place.uniform(draw + 2, radius, top)};
      draw += 3;
      const double room = inner_radius(mould, centre.z) - radius * along_slope;
      if (room <= 0 || centre.x * centre.x + centre.y * centre.y > room * room) continue;
      if (placed.meets(centre, radius)) continue;
      placed.add(centre, radius);
      centres.push_back(centre);
      break;
    }
  }
  return centres;
}

}  // namespace pastefit
