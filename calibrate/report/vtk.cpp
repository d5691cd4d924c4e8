#include "calibrate/report/vtk.h"

#include <bit>
#include <cstring>
#include <span>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"

namespace pastefit {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

/// DataArray element: number of bytes (UInt64) and data, encoded together.
std::string data_array(const std::string& name, const char* type, int components, std::span<const std::byte> values) {
  const std::uint64_t size = values.size();
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return format("<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"binary\">", type, name.c_str(),
                components) +
         base64(bytes) + "</DataArray>\n";
}

std::string data_array(const std::string& name, const std::vector<double>& values) {
  return data_array(name, "Float64", 1, std::as_bytes(std::span(values)));
}
std::string data_array(const std::string& name, const std::vector<Vec3>& values) {
  return data_array(name, "Float64", 3, std::as_bytes(std::span(values)));
}
std::string data_array(const std::string& name, const std::vector<std::int32_t>& values) {
  return data_array(name, "Int32", 1, std::as_bytes(std::span(values)));
}
std::string data_array(const std::string& name, const std::vector<std::int64_t>& values) {
  return data_array(name, "Int64", 1, std::as_bytes(std::span(values)));
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">\n" + content + "</" + name + ">\n";
}

}  // namespace

std::string vtp_of(const VtkFrame& frame) {
  std::vector<std::int64_t> offsets;
  for (std::int64_t end = frame.corners; end <= std::ssize(frame.connectivity); end += frame.corners)
    offsets.push_back(end);
  std::string data;
  for (const VtkColumn& column : frame.data)
    data += std::visit([&](const auto& values) { return data_array(column.name, values); }, column.values);
  return format(
             "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
             "<PolyData>\n<Piece NumberOfPoints=\"%zu\" NumberOf%s=\"%zu\">\n",
             frame.points_m.size(), frame.cells.c_str(), offsets.size()) +
         element("Points", data_array("position", frame.points_m)) + element(frame.data_of, data) +
         element(frame.cells, data_array("connectivity", frame.connectivity) + data_array("offsets", offsets)) +
         "</Piece>\n</PolyData>\n</VTKFile>\n";
}

VtkSeries::VtkSeries(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {}

Faults VtkSeries::add(double time_s, const VtkFrame& frame) {
  const std::string file = name_ + format("_%06d.vtp", frames_++);
  if (auto faults = write_atomically(folder_ / file, vtp_of(frame)); !faults.empty()) return faults;
  entries_ += format("<DataSet timestep=\"%.9g\" file=\"", time_s) + file + "\"/>\n";
  return write_atomically(
      index(), "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" + entries_ +
                   "</Collection>\n</VTKFile>\n");
}

}  // namespace pastefit
