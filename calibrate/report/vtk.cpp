#include "calibrate/report/vtk.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <utility>

#include "calibrate/base/atomic_file.h"

namespace pastefit {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= bytes.size() - i ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

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

}  // namespace

std::string vtp_of(const GrainFrame& frame) {
  const auto count = frame.positions_m.size();
  std::vector<std::int64_t> connectivity(count), offsets(count);
  for (std::size_t i = 0; i < count; ++i) {
    connectivity[i] = static_cast<std::int64_t>(i);
    offsets[i] = connectivity[i] + 1;
  }
  const auto number = std::to_string(count);
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
         "<PolyData>\n<Piece NumberOfPoints=\"" +
         number + "\" NumberOfVerts=\"" + number + "\">\n<Points>\n" +
         data_array<Vec3>("Float64", "position", 3, frame.positions_m) + "</Points>\n<PointData>\n" +
         data_array<double>("Float64", "radius", 1, frame.radii_m) +
         data_array<Vec3>("Float64", "velocity", 3, frame.velocities_m_s) + "</PointData>\n<Verts>\n" +
         data_array<std::int64_t>("Int64", "connectivity", 1, connectivity) +
         data_array<std::int64_t>("Int64", "offsets", 1, offsets) + "</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

VtkSeries::VtkSeries(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {}

Faults VtkSeries::add(const GrainFrame& frame) {
  std::array<char, 32> number{}, time{};
  std::snprintf(number.data(), number.size(), "_%06d.vtp", frames_++);
  std::snprintf(time.data(), time.size(), "%.9g", frame.time_s);
  const std::string file = name_ + number.data();
  auto faults = write_atomically(folder_ / file, vtp_of(frame));
  if (!faults.empty()) return faults;
  entries_ += std::string("<DataSet timestep=\"") + time.data() + "\" file=\"" + file + "\"/>\n";
  return write_atomically(
      index(), "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" + entries_ +
                   "</Collection>\n</VTKFile>\n");
}

}  // namespace pastefit
