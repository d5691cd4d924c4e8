#include "tests/bench/speed/peer_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace pastefit {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

File open_for_writing(const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "w"));
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
  return file;
}

void check_written(std::FILE* file, const std::filesystem::path& path) {
  if (std::fflush(file) != 0 || std::ferror(file)) throw std::runtime_error(path.string() + ": the disk is full?");
}

void write_triangle(std::FILE* out, const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 n = cross(b - a, c - a);
  n = (1 / norm(n)) * n;
  std::fprintf(out, "facet normal %.9g %.9g %.9g\nouter loop\n", n.x, n.y, n.z);
  for (const Vec3& p : {a, b, c}) std::fprintf(out, "vertex %.9g %.9g %.9g\n", p.x, p.y, p.z);
  std::fprintf(out, "endloop\nendfacet\n");
}

}  // namespace

void write_grains(const std::filesystem::path& path, const std::vector<Vec3>& centres, double radius_m,
                  double density_kg_m3, const Space& space) {
  const File file = open_for_writing(path);
  std::FILE* out = file.get();
  std::fprintf(out, "grains of pastefit-bench\n\n%zu atoms\n1 atom types\n", centres.size());
  std::fprintf(out, "%.9g %.9g xlo xhi\n%.9g %.9g ylo yhi\n%.9g %.9g zlo zhi\n\nAtoms\n\n", space.low.x, space.high.x,
               space.low.y, space.high.y, space.low.z, space.high.z);
  std::size_t n = 0;
  for (const Vec3& p : centres)
    std::fprintf(out, "%zu 1 %.17g %.17g %.17g %.17g %.17g\n", ++n, 2 * radius_m, density_kg_m3, p.x, p.y, p.z);
  check_written(out, path);
}

void write_mould(const std::filesystem::path& path, const Mould& mould) {
  constexpr int kAround = 64, kHigh = 4;
  const File file = open_for_writing(path);
  const auto corner = [&](int around, int high) {
    const double share = static_cast<double>(high) / kHigh, angle = 2 * std::numbers::pi * around / kAround;
    const double r = mould.base_radius_m + share * (mould.top_radius_m - mould.base_radius_m);
    return Vec3{r * std::cos(angle), r * std::sin(angle), share * mould.height_m};
  };
  std::fprintf(file.get(), "solid mould\n");
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kHigh; ++k) {
      write_triangle(file.get(), corner(i, k), corner(i + 1, k), corner(i + 1, k + 1));
      write_triangle(file.get(), corner(i, k), corner(i + 1, k + 1), corner(i, k + 1));
    }
  std::fprintf(file.get(), "endsolid mould\n");
  check_written(file.get(), path);
}

void write_plate(const std::filesystem::path& path, double length_m) {
  const File file = open_for_writing(path);
  const double h = 0.5 * length_m;
  std::fprintf(file.get(), "solid plate\n");
  write_triangle(file.get(), {-h, -h, 0}, {h, -h, 0}, {h, h, 0});
  write_triangle(file.get(), {-h, -h, 0}, {h, h, 0}, {-h, h, 0});
  std::fprintf(file.get(), "endsolid plate\n");
  check_written(file.get(), path);
}

void write_bed(const std::filesystem::path& path, const Bed& bed) {
  std::ofstream out(path, std::ios::binary);
  const BedSize size{static_cast<double>(bed.centres.size()), bed.length_m, bed.width_m};
  out.write(reinterpret_cast<const char*>(&size), sizeof size);
  out.write(reinterpret_cast<const char*>(bed.centres.data()),
            static_cast<std::streamsize>(bed.centres.size() * sizeof(Vec3)));
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

BedSize read_bed_size(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  BedSize size;
  in.read(reinterpret_cast<char*>(&size), sizeof size);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  return size;
}

Bed read_bed(const std::filesystem::path& path) {
  const BedSize size = read_bed_size(path);
  Bed bed;
  bed.length_m = size.length_m;
  bed.width_m = size.width_m;
  bed.centres.resize(static_cast<std::size_t>(size.grains));
  std::ifstream in(path, std::ios::binary);
  in.seekg(sizeof size);
  in.read(reinterpret_cast<char*>(bed.centres.data()), static_cast<std::streamsize>(bed.centres.size() * sizeof(Vec3)));
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  for (const Vec3& p : bed.centres) bed.top_m = std::max(bed.top_m, p.z + kSceneRadius);
  return bed;
}

}  // namespace pastefit
