#include "calibrate/report/vtk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/report/links.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

/// DataArray element: number of bytes (UInt64) and data, encoded together.
template <class Value>
std::string data_array(const std::string& name, const std::vector<Value>& values) {
  constexpr bool vectors = std::is_same_v<Value, Vec3>, whole = std::is_integral_v<Value>;
  const char* type = !whole ? "Float64" : sizeof(Value) == 4 ? "Int32" : "Int64";
  const auto data = std::as_bytes(std::span(values));
  const std::uint64_t size = data.size();
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, data.data(), size);
  return format("<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"binary\">", type, name,
                vectors ? 3 : 1) +
         base64(bytes) + "</DataArray>\n";
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
             frame.points_m.size(), frame.cells, offsets.size()) +
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

namespace {

constexpr int kSides = 72;  // of round walls

/// Largest distance of grains from the axis: visible part of an infinite plane.
double extent_of(const Particles& grains) {
  double reach = 0;
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    const Motion& motion = grains.motion[i];
    reach =
        std::max({reach, std::fabs(motion.position.x) + motion.radius, std::fabs(motion.position.y) + motion.radius});
  }
  return 1.2 * reach;
}

/// Appends walls to a frame.
class WallDraftsman {
 public:
  explicit WallDraftsman(double reach) : reach_(reach) {}

  void draw(const Wall& wall) {
    std::visit([this](const auto& shape) { add(shape); }, wall.shape);
    walls_.resize(frame_.connectivity.size() / 4, wall_++);
  }

  VtkFrame take() {
    frame_.data = {{"wall", std::move(walls_)}};
    return std::move(frame_);
  }

 private:
  void add_quadrangle(const std::array<Vec3, 4>& corners) {
    for (const Vec3& corner : corners) {
      frame_.connectivity.push_back(std::ssize(frame_.points_m));
      frame_.points_m.push_back(corner);
    }
  }

  void add_rectangle(const Vec3& centre, const Vec3& along, const Vec3& across) {
    add_quadrangle(
        {centre - along - across, centre + along - across, centre + along + across, centre - along + across});
  }

  void add(const Plate& plate) {
    add_rectangle(plate.centre, plate.half_length * plate.along, plate.half_width * plate.across);
  }

  void add(const Plane& plane) {
    const Vec3 aside = std::fabs(plane.normal.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 along = cross(aside, plane.normal);
    const Vec3 unit = (1 / norm(along)) * along;
    add_rectangle(plane.point, reach_ * unit, reach_ * cross(plane.normal, unit));
  }

  void add(const Shell& shell) {
    const auto corner_at = [&](int side, double radius, double above) {
      const double angle = 2 * std::numbers::pi * side / kSides;
      return shell.base + Vec3{radius * std::cos(angle), radius * std::sin(angle), above};
    };
    for (int side = 0; side < kSides; ++side)
      add_quadrangle({corner_at(side, shell.base_radius, 0), corner_at(side + 1, shell.base_radius, 0),
                      corner_at(side + 1, shell.top_radius, shell.height),
                      corner_at(side, shell.top_radius, shell.height)});
  }

  /// Draws the ribs within the grains: two sides and the crest of each.
  void add(const Ribs& ribs) {
    const Vec3 across{0, reach_, 0}, up{0, 0, ribs.height / 2}, half{ribs.thickness / 2, 0, 0};
    const auto first = static_cast<int>(std::ceil((-reach_ - ribs.base.x) / ribs.pitch));
    for (int bar = first; ribs.base.x + bar * ribs.pitch <= reach_; ++bar) {
      const Vec3 middle = ribs.base + Vec3{bar * ribs.pitch, 0, ribs.height / 2};
      add_rectangle(middle - half, up, across);
      add_rectangle(middle + half, up, across);
      add_rectangle(middle + up, half, across);
    }
  }

  double reach_;
  std::int32_t wall_ = 0;
  std::vector<std::int32_t> walls_;
  VtkFrame frame_{.cells = "Polys", .corners = 4, .data_of = "CellData"};
};

}  // namespace

VtkFrame grain_frame(const World& world) {
  const Particles& grains = world.particles;
  VtkFrame frame{.cells = "Verts", .data_of = "PointData"};
  const auto touching = coordination_of(links_of(world), grains.count());
  std::vector<Vec3> velocities, spins;
  std::vector<double> radii;
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    frame.points_m.push_back(grains.motion[i].position);
    frame.connectivity.push_back(i);
    radii.push_back(grains.motion[i].radius);
    velocities.push_back(grains.velocity[i].linear);
    spins.push_back(grains.velocity[i].angular);
  }
  frame.data = {{"radius", std::move(radii)},
                {"velocity", std::move(velocities)},
                {"spin", std::move(spins)},
                {"coordination", std::vector<std::int32_t>(touching.begin(), touching.end())}};
  return frame;
}

VtkFrame link_frame(const World& world) {
  VtkFrame frame{.cells = "Lines", .corners = 2, .data_of = "CellData"};
  std::vector<std::int32_t> touching;
  std::vector<double> overlaps, forces;
  for (const Link& link : links_of(world)) {
    for (const std::int32_t grain : {link.first, link.second}) {
      frame.connectivity.push_back(std::ssize(frame.points_m));
      frame.points_m.push_back(world.particles.motion[grain].position);
    }
    touching.push_back(link.touching ? 1 : 0);
    overlaps.push_back(link.overlap_m);
    forces.push_back(link.force_n);
  }
  frame.data = {{"touching", std::move(touching)}, {"overlap", std::move(overlaps)}, {"force", std::move(forces)}};
  return frame;
}

VtkFrame wall_frame(const World& world) {
  WallDraftsman draftsman(extent_of(world.particles));
  for (const Wall& wall : world.walls) draftsman.draw(wall);
  return draftsman.take();
}

}  // namespace pastefit
