#pragma once

#include <filesystem>

#include "core/apparatus/slump/slump_test.h"
#include "tests/bench/speed/scene.h"

namespace pastefit {

/// Corners of the space that an engine has to keep grains and walls in.
struct Space {
  Vec3 low, high;
};

/// Writes the grains in LAMMPS' data format (LIGGGHTS and our Yade decks read it too), all digits kept.
/// Throws std::runtime_error if the file cannot be written; so do the functions below.
void write_grains(const std::filesystem::path& file, const std::vector<Vec3>& centres, double radius_m,
                  double density_kg_m3, const Space& space);

/// Writes the mould's side as triangles (STL): 64 around, 4 high.
void write_mould(const std::filesystem::path& file, const Mould& mould);

/// Writes a level square plate at z = 0, centred at the origin, as triangles (STL).
void write_plate(const std::filesystem::path& file, double length_m);

/// Grains of a scene on the disk, for children that run it: nothing of it stays in the memory of the parent.
void write_bed(const std::filesystem::path& file, const Bed& bed);
struct BedSize {
  double grains = 0, length_m = 0, width_m = 0;
};
BedSize read_bed_size(const std::filesystem::path& file);
Bed read_bed(const std::filesystem::path& file);

}  // namespace pastefit
