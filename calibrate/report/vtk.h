#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec3.h"

namespace pastefit {

class World;

/// Grains at one moment, as plain columns of equal length.
struct GrainFrame {
  std::vector<Vec3> positions_m;
  std::vector<Vec3> velocities_m_s;
  std::vector<Vec3> spins_rad_s;
  std::vector<double> radii_m;
  std::vector<std::int32_t> coordination;  ///< grains that it touches
};

/// Contacts and bridges between them: from one centre to the other.
struct LinkFrame {
  std::vector<Vec3> ends_m;            ///< two for each link, one after the other
  std::vector<std::int32_t> touching;  ///< 1, or 0 for a bridge across a gap
  std::vector<double> overlaps_m;      ///< negative: a gap
  std::vector<double> forces_n;        ///< of the laws along the normal, repulsion positive, without dampers
};

/// Walls as polygons: what is round has 72 sides, of an infinite plane the square about the grains is shown.
struct WallFrame {
  std::vector<Vec3> corners_m;
  std::vector<std::array<std::int64_t, 4>> quadrangles;  ///< of corners
  std::vector<std::int32_t> walls;                       ///< of which wall each is, from 0
};

GrainFrame grain_frame(const World& world);
LinkFrame link_frame(const World& world);
WallFrame wall_frame(const World& world);

/// A frame as a ParaView file (VTK XML PolyData), numbers in binary (base64). Grains: one vertex each, point data
/// "radius", "velocity", "spin", "coordination". Links: one line each, cell data "touching", "overlap", "force". Walls:
/// polygons, cell data "wall". Source of the format: VTK User's Guide, chapter on file formats.
std::string vtp_of(const GrainFrame& frame);
std::string vtp_of(const LinkFrame& frame);
std::string vtp_of(const WallFrame& frame);

/// A series of frames in a folder: NAME_000000.vtp, NAME_000001.vtp, ... and NAME.pvd, which lists them with their
/// times and is complete after every frame.
class VtkSeries {
 public:
  VtkSeries(std::filesystem::path folder, std::string name);
  /// `vtp`: from `vtp_of`. Errors: a file cannot be written.
  Faults add(double time_s, const std::string& vtp);
  std::filesystem::path index() const { return folder_ / (name_ + ".pvd"); }

 private:
  std::filesystem::path folder_;
  std::string name_;
  std::string entries_;
  int frames_ = 0;
};

}  // namespace pastefit
