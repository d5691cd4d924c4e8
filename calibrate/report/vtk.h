#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/result.h"
#include "core/vec3.h"

namespace pastefit {

class World;

/// Data array on the points or cells of a frame.
struct VtkColumn {
  std::string name;
  std::variant<std::vector<double>, std::vector<Vec3>, std::vector<std::int32_t>> values;
};

/// Data of one time; all cells have the same number of corners.
struct VtkFrame {
  std::string cells;  ///< "Verts", "Lines" or "Polys"
  std::int64_t corners = 1;
  std::vector<Vec3> points_m = {};
  std::vector<std::int64_t> connectivity = {};  ///< point indices of the cells' corners
  std::string data_of;                          ///< "PointData" or "CellData"
  std::vector<VtkColumn> data = {};
};

/// Grains as vertices, with "radius", "velocity", "spin" and "coordination", the number of touched grains.
VtkFrame grain_frame(const World& world);

/// Contacts and bridges as lines between centres, with "touching", 1, or 0 for a bridge across a gap; "overlap",
/// negative for a gap; "force", normal force of the laws, repulsion positive, without dampers.
VtkFrame link_frame(const World& world);

/// Walls as polygons: 72 sides for round walls, a square around the grains for infinite planes. "wall": index of the
/// wall, from 0.
VtkFrame wall_frame(const World& world);

/// Frame as a ParaView file (VTK XML PolyData) with binary data (base64). Source: VTK User's Guide, chapter on file
/// formats.
std::string vtp_of(const VtkFrame& frame);

/// Series of frames in a folder: NAME_000000.vtp, NAME_000001.vtp, ... and NAME.pvd, which lists them with their times
/// and is valid after every frame.
class VtkSeries {
 public:
  VtkSeries(std::filesystem::path folder, std::string name);
  /// Errors: a file cannot be written.
  Faults add(double time_s, const VtkFrame& frame);
  std::filesystem::path index() const { return folder_ / (name_ + ".pvd"); }

 private:
  std::filesystem::path folder_;
  std::string name_;
  std::string entries_;
  int frames_ = 0;
};

}  // namespace pastefit
