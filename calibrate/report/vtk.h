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

/// Numbers of one kind at points or cells of a frame.
struct VtkColumn {
  std::string name;
  std::variant<std::vector<double>, std::vector<Vec3>, std::vector<std::int32_t>> values;
};

/// What is shown of one moment: cells of equally many corners each.
struct VtkFrame {
  std::string cells;  ///< "Verts", "Lines" or "Polys"
  std::int64_t corners = 1;
  std::vector<Vec3> points_m = {};
  std::vector<std::int64_t> connectivity = {};  ///< the cells' corners by their places among the points
  std::string data_of;                          ///< "PointData" or "CellData"
  std::vector<VtkColumn> data = {};
};

/// Grains, one vertex each: "radius", "velocity", "spin", "coordination", the grains that it touches.
VtkFrame grain_frame(const World& world);

/// Contacts and bridges between grains, from one centre to the other: "touching", 1, or 0 for a bridge across a gap;
/// "overlap", negative for a gap; "force" of the laws along the normal, repulsion positive, without dampers.
VtkFrame link_frame(const World& world);

/// Walls as polygons: what is round has 72 sides, of an infinite plane the square about the grains is shown. "wall": of
/// which wall each is, from 0.
VtkFrame wall_frame(const World& world);

/// A frame as a ParaView file (VTK XML PolyData), numbers in binary (base64). Source of the format: VTK User's Guide,
/// chapter on file formats.
std::string vtp_of(const VtkFrame& frame);

/// A series of frames in a folder: NAME_000000.vtp, NAME_000001.vtp, ... and NAME.pvd, which lists them with their
/// times and is complete after every frame.
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
