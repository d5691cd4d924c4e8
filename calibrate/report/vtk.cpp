#include "calibrate/report/vtk.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"

namespace pastefit {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

/// A DataArray element: the number of bytes (UInt64) and the bytes, encoded as one.
template <class T>
std::string data_array(const std::string& type, const std::string& name, int components, std::span<const T> values) {
  const std::uint64_t size = values.size_bytes();
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) +
         "\" format=\"binary\">" + base64(bytes) + "</DataArray>\n";
}

/// DataArrays of a file, each a DataArray element.
class DataArrays {
 public:
  void add(const std::string& name, std::span<const double> values) { text_ += data_array("Float64", name, 1, values); }
  void add(const std::string& name, std::span<const Vec3> values) { text_ += data_array("Float64", name, 3, values); }
  void add(const std::string& name, std::span<const std::int32_t> values) {
    text_ += data_array("Int32", name, 1, values);
  }
  std::string in(const std::string& element) const { return "<" + element + ">\n" + text_ + "</" + element + ">\n"; }

 private:
  std::string text_;
};

/// Cells of so many corners each, which are those of `connectivity`.
std::string cells(const std::string& element, std::span<const std::int64_t> connectivity, std::int64_t corners) {
  std::vector<std::int64_t> offsets;
  for (std::int64_t end = corners; end <= std::ssize(connectivity); end += corners) offsets.push_back(end);
  return "<" + element + ">\n" + data_array<std::int64_t>("Int64", "connectivity", 1, connectivity) +
         data_array<std::int64_t>("Int64", "offsets", 1, offsets) + "</" + element + ">\n";
}

/// `kind` of cells: "Verts", "Lines" or "Polys".
std::string poly_data(std::span<const Vec3> points, const std::string& kind, std::int64_t corners,
                      std::span<const std::int64_t> connectivity, const std::string& data) {
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
         "<PolyData>\n<Piece NumberOfPoints=\"" +
         std::to_string(points.size()) + "\" NumberOf" + kind + "=\"" +
         std::to_string(std::ssize(connectivity) / corners) + "\">\n<Points>\n" +
         data_array<Vec3>("Float64", "position", 3, points) + "</Points>\n" + data +
         cells(kind, connectivity, corners) + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

/// 0, 1, ...: every point once, in its order.
std::vector<std::int64_t> in_order(std::size_t points) {
  std::vector<std::int64_t> out(points);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

}  // namespace

std::string vtp_of(const GrainFrame& frame) {
  DataArrays of_points;
  of_points.add("radius", std::span<const double>(frame.radii_m));
  of_points.add("velocity", std::span<const Vec3>(frame.velocities_m_s));
  of_points.add("spin", std::span<const Vec3>(frame.spins_rad_s));
  of_points.add("coordination", std::span<const std::int32_t>(frame.coordination));
  return poly_data(frame.positions_m, "Verts", 1, in_order(frame.positions_m.size()), of_points.in("PointData"));
}

std::string vtp_of(const LinkFrame& frame) {
  DataArrays of_cells;
  of_cells.add("touching", std::span<const std::int32_t>(frame.touching));
  of_cells.add("overlap", std::span<const double>(frame.overlaps_m));
  of_cells.add("force", std::span<const double>(frame.forces_n));
  return poly_data(frame.ends_m, "Lines", 2, in_order(frame.ends_m.size()), of_cells.in("CellData"));
}

std::string vtp_of(const WallFrame& frame) {
  DataArrays of_cells;
  of_cells.add("wall", std::span<const std::int32_t>(frame.walls));
  std::vector<std::int64_t> connectivity;
  for (const auto& corners : frame.quadrangles) connectivity.insert(connectivity.end(), corners.begin(), corners.end());
  return poly_data(frame.corners_m, "Polys", 4, connectivity, of_cells.in("CellData"));
}

VtkSeries::VtkSeries(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {}

Faults VtkSeries::add(double time_s, const std::string& vtp) {
  std::array<char, 32> number{}, time{};
  std::snprintf(number.data(), number.size(), "_%06d.vtp", frames_++);
  std::snprintf(time.data(), time.size(), "%.9g", time_s);
  const std::string file = name_ + number.data();
  auto faults = write_atomically(folder_ / file, vtp);
  if (!faults.empty()) return faults;
  entries_ += std::string("<DataSet timestep=\"") + time.data() + "\" file=\"" + file + "\"/>\n";
  return write_atomically(
      index(), "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" + entries_ +
                   "</Collection>\n</VTKFile>\n");
}

}  // namespace pastefit
