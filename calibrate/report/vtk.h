#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec3.h"

namespace pastefit {

/// Grains at one moment, as plain columns of equal length.
struct GrainFrame {
  double time_s = 0;
  std::vector<Vec3> positions_m;
  std::vector<Vec3> velocities_m_s;
  std::vector<double> radii_m;
};

/// The frame as a ParaView file (VTK XML PolyData, one vertex per grain, point data "radius" and "velocity"), numbers
/// in binary (base64). Source of the format: VTK User's Guide, chapter on file formats.
std::string vtp_of(const GrainFrame& frame);

/// A series of frames in a folder: NAME_000000.vtp, NAME_000001.vtp, ... and NAME.pvd, which lists them with their
/// times and is complete after every frame.
class VtkSeries {
 public:
  VtkSeries(std::filesystem::path folder, std::string name);
  /// Errors: a file cannot be written.
  Faults add(const GrainFrame& frame);
  std::filesystem::path index() const { return folder_ / (name_ + ".pvd"); }

 private:
  std::filesystem::path folder_;
  std::string name_;
  std::string entries_;
  int frames_ = 0;
};

}  // namespace pastefit
