#include "core/apparatus/pour.h"

#include <algorithm>
#include <numbers>

#include "core/random.h"

namespace pastefit {

namespace {

constexpr double kLoosest = 2.15;  // spacing of the lattice over the largest radius

/// Grain n of a scene, put there.
void add_grain(LooseGrains& grains, const Vec3& place, double radius) {
  grains.centres.push_back(place);
  grains.radii.push_back(radius);
  grains.solid_volume_m3 += sphere_volume_m3(radius);
}

}  // namespace

LooseGrains pour(const GrainSizes& sizes, std::uint64_t seed, double enough, double widest,
                 const std::function<double(double)>& inner_radius) {
  const double largest = largest_radius(sizes);
  const double spacing = kLoosest * largest;
  const double jitter = 0.5 * spacing - largest;
  const RandomStream place(seed, "pour-position");
  const int across = static_cast<int>(widest / spacing) + 1;
  LooseGrains grains;
  std::uint64_t n = 0;
  for (int layer = 0; grains.solid_volume_m3 < enough; ++layer) {
    const double z = spacing * (layer + 0.5);
    const double room = std::min(inner_radius(z - jitter), inner_radius(z + jitter)) - 1.01 * largest;
    for (int iy = -across; iy <= across; ++iy)
      for (int ix = -across; ix <= across; ++ix) {
        if (grains.solid_volume_m3 >= enough) continue;
        const double shift = layer % 2 == 0 ? 0.0 : 0.5;
        const Vec3 p{spacing * (ix + shift) + place.uniform(3 * n, -jitter, jitter),
                     spacing * (iy + shift) + place.uniform(3 * n + 1, -jitter, jitter),
                     z + place.uniform(3 * n + 2, -jitter, jitter)};
        if (p.x * p.x + p.y * p.y > room * room) continue;
        add_grain(grains, p, draw_radius(sizes, seed, n));
        ++n;
      }
  }
  return grains;
}

LooseGrains pour(const GrainSizes& sizes, std::uint64_t seed, double enough, const OpenBox& box) {
  const double largest = largest_radius(sizes), spacing = kLoosest * largest;
  const double jitter = 0.5 * spacing - largest;
  const double room = box.width_m - 2.02 * largest - 2 * jitter;  // for the lattice
  const int along = static_cast<int>(box.length_m / spacing), across = static_cast<int>(room / spacing) + 1;
  const double step_x = box.length_m / along, step_y = across > 1 ? room / (across - 1) : 0;
  const RandomStream place(seed, "pour-position");
  LooseGrains grains;
  std::uint64_t n = 0;
  for (int layer = 0; grains.solid_volume_m3 < enough; ++layer)
    for (int iy = 0; iy < across; ++iy)
      for (int ix = 0; ix < along && grains.solid_volume_m3 < enough; ++ix, ++n) {
        const double shift = layer % 2 == 0 ? 0.0 : 0.5;
        const auto off = [&](std::uint64_t k) { return place.uniform(3 * n + k, -jitter, jitter); };
        const Vec3 p{step_x * (ix + shift) + off(0), step_y * iy - 0.5 * room + off(1),
                     box.floor_m + spacing * (layer + 0.5) + off(2)};
        add_grain(grains, p, draw_radius(sizes, seed, n));
      }
  return grains;
}

double sphere_volume_m3(double r) {
  return 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

double top_of(const LooseGrains& grains) {
  double top = 0;
  for (std::size_t i = 0; i < grains.centres.size(); ++i) top = std::max(top, grains.centres[i].z + grains.radii[i]);
  return top;
}

}  // namespace pastefit
