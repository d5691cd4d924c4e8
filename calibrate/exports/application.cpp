#include "calibrate/exports/application.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "core/apparatus/dimension.h"

namespace pastefit {

namespace {

constexpr Range kPlace{-1e6, 1e6}, kSpeed{-100, 100}, kLength{0, 1e6, true}, kTime{0, 86400};

/// Three numbers, `per_si` of the key's unit to one of SI.
template <class Fields>
void describe_vector(Fields& fields, const Key& key, Vec3& target, const Range& range, double per_si = 1) {
  std::vector<double> numbers;
  fields.numbers(key, numbers, range, Need::required, 3, 3);
  if (numbers.size() == 3) target = (1 / per_si) * Vec3{numbers[0], numbers[1], numbers[2]};
}

/// A direction must have a length.
template <class Fields>
void describe_direction(Fields& fields, const Key& key, Vec3& target, const Range& range) {
  target = {0, 0, 1};
  describe_vector(fields, key, target, range);
  if constexpr (Fields::reads)
    if (norm(target) == 0)
      fields.fault(key.name, "has no direction", "three numbers that are not all 0, e.g. [0, 0, -1]");
}

void describe_slide(auto& fields, Slide& slide) {
  fields.number({"from_s", "start of the motion"}, slide.from_s, kTime, Need::required);
  describe_direction(fields, {"velocity_m_s", "velocity, three components"}, slide.velocity_m_s, kSpeed);
  fields.number({"distance_mm", "length of the way"}, slide.distance_m, kLength, Need::required, mm);
}

void describe_rotation(auto& fields, Rotation& rotation) {
  fields.number({"from_s", "start of the rotation, which does not end; default 0"}, rotation.from_s, kTime,
                Need::optional);
  describe_vector(fields, {"point_mm", "a point of the axis"}, rotation.point_m, kPlace, mm);
  describe_direction(fields, {"axis", "direction of the axis; the rotation follows the right-hand rule"}, rotation.axis,
                     kPlace);
  fields.number({"revolutions_per_min", "speed of rotation; negative: against the right-hand rule"},
                rotation.revolutions_per_min, {-1e4, 1e4}, Need::required);
}

void describe_part(auto& fields, MachinePart& part) {
  static constexpr std::array units{Named<bool>{"mm", false}, Named<bool>{"m", true}};
  fields.text({"file", "STL file of the surface, beside this file"}, part.file, Need::required);
  fields.choice({"unit", "unit of the STL file; default mm"}, part.in_metres, units, Need::optional);
  for (const auto& one : surface_dimensions)
    fields.number({one.field, std::string(one.meaning) + "; default: that of the card's table"},
                  part.contact.*one.value, {one.smallest, one.largest}, Need::optional);
  fields.optional_object({"slide", "straight motion, e.g. of a gate"}, part.slide,
                         [](auto& inner, Slide& slide) { describe_slide(inner, slide); });
  fields.optional_object({"rotation", "rotation, e.g. of a mixer's blade"}, part.rotation,
                         [](auto& inner, Rotation& rotation) { describe_rotation(inner, rotation); });
}

void describe_feed(auto& fields, Feed& feed) {
  describe_vector(fields, {"centre_mm", "centre of the disc from which the grains come"}, feed.centre_m, kPlace, mm);
  fields.number({"radius_mm", "radius of the disc"}, feed.radius_m, kLength, Need::required, mm);
  describe_direction(fields, {"velocity_m_s", "velocity of the grains, three components; the disc is across it"},
                     feed.velocity_m_s, kSpeed);
  fields.number({"mass_kg", "mass that is fed in all"}, feed.mass_kg, {0, 1e9, true}, Need::required);
  fields.number({"rate_kg_s", "mass that is fed in a second"}, feed.rate_kg_s, {0, 1e6, true}, Need::required);
}

void describe_plane(auto& fields, OrientedPlane& plane, const char* normal) {
  describe_vector(fields, {"point_mm", "a point of the plane"}, plane.point_m, kPlace, mm);
  describe_direction(fields, {"normal", normal}, plane.normal, kPlace);
}

void describe_application(auto& fields, Application& application, auto with_part) {
  fields.text({"title", "title, one line"}, application.title, Need::required);
  fields.entries({"parts", "surfaces of the machine, by names of your choice"}, application.parts, &MachinePart::name,
                 Need::required, [&](auto& entries, const Key& own, MachinePart& part) {
                   with_part(part);
                   entries.object(own, Need::required, [&](auto& inner) { describe_part(inner, part); });
                 });
  fields.object({"feed", "stream of grains into the machine; it begins at 0 s"}, Need::required,
                [&](auto& inner) { describe_feed(inner, application.feed); });
  fields.optional_object(
      {"outlet", "plane beyond which grains are discharged"}, application.outlet,
      [](auto& inner, OrientedPlane& outlet) { describe_plane(inner, outlet, "direction out of the machine"); });
  fields.optional_object({"flow_depth", "place at which the depth of the flow is measured"}, application.depth,
                         [](auto& inner, DepthGauge& gauge) {
                           describe_plane(inner, gauge.floor, "direction away from the floor");
                           inner.number(
                               {"radius_mm", "grains within this distance of the point, along the floor, count"},
                               gauge.radius_m, kLength, Need::required, mm);
                         });
  fields.number({"duration_s", "end of the simulation"}, application.duration_s, {0, 86400, true}, Need::required);
}

/// What the keys cannot say one by one, and the STL files.
void complete_part(ObjectReader& reader, MachinePart& part, const std::filesystem::path& folder) {
  const std::string key = "parts." + part.name;
  const auto letter = [](char one) { return std::isalnum(static_cast<unsigned char>(one)) || one == '_'; };
  constexpr std::size_t longest = 64;
  if (part.name.empty() || part.name.size() > longest || !std::ranges::all_of(part.name, letter))
    reader.fault(key, "is not a name of a part", "at most 64 letters, digits and _");
  if (part.slide && part.rotation) reader.fault(key, "slides and rotates", "one motion for each part");
  if (part.rotation && part.rotation->revolutions_per_min == 0)
    reader.fault(key + ".rotation.revolutions_per_min", "is 0", "leave out the rotation");
  if (part.file.empty()) return;
  auto triangles = read_stl(folder / part.file, part.in_metres ? 1 : 1 / mm);
  if (triangles.ok()) {
    part.triangles = std::move(triangles).value();
    return;
  }
  for (const Fault& fault : triangles.faults())
    reader.fault(key + ".file", in_quotes(part.file) + " " + fault.what, fault.remedy);
}

bool is_beyond(const Vec3& at, const OrientedPlane& plane) {
  return dot(at - plane.point_m, plane.normal) > 0;
}

/// The feed belongs inside the machine and above its floor.
void check_planes(ObjectReader& reader, const Application& application) {
  const Vec3& feed = application.feed.centre_m;
  if (application.outlet && is_beyond(feed, *application.outlet))
    reader.fault("outlet.normal", "puts the feed beyond the outlet", "the opposite direction, out of the machine");
  if (application.depth && !is_beyond(feed, application.depth->floor))
    reader.fault("flow_depth.normal", "puts the feed below the floor", "the opposite direction, away from the floor");
}

void check_times(ObjectReader& reader, const Application& application) {
  const Feed& feed = application.feed;
  if (application.parts.empty()) reader.fault("parts", "is empty", "one part at least");
  double end = feed.mass_kg / feed.rate_kg_s + feed.radius_m / norm(feed.velocity_m_s);
  for (const MachinePart& part : application.parts) {
    if (part.slide) end = std::max(end, part.slide->until_s());
    if (part.rotation) end = std::max(end, part.rotation->from_s);
  }
  if (application.duration_s <= end)
    reader.fault("duration_s",
                 "is " + shown(application.duration_s) + " s, but the feed and the motions take " + shown(end) + " s",
                 "a longer duration");
}

/// The file itself, or the shipped one of this name.
std::filesystem::path application_file(const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_extension() || std::filesystem::is_regular_file(file, error)) return file;
  for (const std::filesystem::path& folder : data_folders()) {
    auto shipped = (folder / "applications" / file).concat(".json");
    if (std::filesystem::is_regular_file(shipped, error)) return shipped;
  }
  return file;
}

}  // namespace

double Application::start_s() const {
  double start = 0;
  for (const MachinePart& part : parts) {
    if (part.slide) start = std::max(start, part.slide->from_s);
    if (part.rotation) start = std::max(start, part.rotation->from_s);
  }
  return start;
}

std::pair<Vec3, Vec3> Application::bounds() const {
  Vec3 low = feed.centre_m, high = feed.centre_m;
  const auto include = [&](const Vec3& at, double margin) {
    low = {std::min(low.x, at.x - margin), std::min(low.y, at.y - margin), std::min(low.z, at.z - margin)};
    high = {std::max(high.x, at.x + margin), std::max(high.y, at.y + margin), std::max(high.z, at.z + margin)};
  };
  include(feed.centre_m, feed.radius_m);
  for (const MachinePart& part : parts)
    for (const Triangle& triangle : part.triangles)
      for (const Vec3& corner : triangle) {
        include(corner, 0);
        if (part.slide) include(corner + (part.slide->until_s() - part.slide->from_s) * part.slide->velocity_m_s, 0);
        if (!part.rotation) continue;
        const Vec3 axis = (1 / norm(part.rotation->axis)) * part.rotation->axis, from = corner - part.rotation->point_m;
        const Vec3 along = dot(from, axis) * axis;  // the circle of this corner is within a sphere about its centre
        include(part.rotation->point_m + along, norm(from - along));
      }
  return {low, high};
}

Result<Application> read_application(const std::filesystem::path& asked, const WallContact& usual) {
  const std::filesystem::path file = application_file(asked);
  return read_file(file, [&](const nlohmann::json& document) -> Result<Application> {
    Application application;
    const Faults found = read_document(document, "pastefit-application-1", [&](ObjectReader& reader) {
      const Faults& faults = reader.faults();
      describe_application(reader, application, [&](MachinePart& part) { part.contact = usual; });
      for (MachinePart& part : application.parts) complete_part(reader, part, file.parent_path());
      if (faults.empty()) check_planes(reader, application);
      if (faults.empty()) check_times(reader, application);
    });
    if (!found.empty()) return found;
    return application;
  });
}

double mean_residence_s(const Application& application) {
  constexpr double gravity_m_s2 = 9.81, slowed = 2;
  const Feed& feed = application.feed;
  const double fed_s = std::min(feed.mass_kg / feed.rate_kg_s, application.duration_s) / 2;  // of the mean grain
  const double until_the_end = application.duration_s - fed_s;
  if (!application.outlet) return until_the_end;
  if (const double start = application.start_s(); start > 0) return (start + application.duration_s) / 2 - fed_s;
  const double fall_m = std::max(0.0, feed.centre_m.z - application.outlet->point_m.z);
  return std::min(until_the_end, slowed * std::sqrt(2 * fall_m / gravity_m_s2));
}

double fastest_m_s(const Application& application) {
  double fastest = norm(application.feed.velocity_m_s);
  for (const MachinePart& part : application.parts) {
    if (part.slide) fastest = std::max(fastest, norm(part.slide->velocity_m_s));
    if (!part.rotation) continue;
    const double turns_s = std::fabs(part.rotation->revolutions_per_min) / 60;
    for (const Triangle& triangle : part.triangles)
      for (const Vec3& corner : triangle) {
        const Vec3 around = cross(part.rotation->axis, corner - part.rotation->point_m);
        fastest = std::max(fastest, 2 * std::numbers::pi * turns_s * norm(around) / norm(part.rotation->axis));
      }
  }
  return fastest;
}

Faults unsuitable_grains(const Application& application, double largest_radius, double density) {
  constexpr double fewest_radii = 4, solid_share = 0.25;  // LIGGGHTS places grains at random, without overlap
  const Feed& feed = application.feed;
  Faults faults;
  if (feed.radius_m < fewest_radii * largest_radius)
    faults.push_back(
        {"feed.radius_mm",
         "is " + shown(feed.radius_m * mm) + " mm, too narrow for grains of radius " + shown(largest_radius * mm) +
             " mm",
         "at least " + shown(fewest_radii * largest_radius * mm) + " mm, or finer grains (pastefit rescale)"});
  const double area = std::numbers::pi * feed.radius_m * feed.radius_m;
  const double most = solid_share * density * area * norm(feed.velocity_m_s);
  if (feed.rate_kg_s > most)
    faults.push_back(
        {"feed.rate_kg_s",
         "is " + shown(feed.rate_kg_s) + " kg/s, more than passes the disc at this velocity, " + plain(most) + " kg/s",
         "a larger radius, a higher velocity, or a lower rate"});
  constexpr double fewest = 10, most_grains = 5e6;
  const double grains = feed.mass_kg / (4.0 / 3 * std::numbers::pi * std::pow(largest_radius, 3) * density);
  if (grains < fewest || grains > most_grains)
    faults.push_back({"feed.mass_kg", "is " + plain(grains) + " of the largest grains", "ten to five million of them"});
  return faults;
}

ObjectSchema::Json application_schema() {
  ObjectSchema schema("pastefit-application-1");
  Application any;
  describe_application(schema, any, [](MachinePart&) {});
  return schema.document(
      "pastefit application",
      "A machine in which the material of a card is simulated: chute, hopper, mixer. The program also "
      "checks that the STL files are readable, and that radius, rate and mass of the feed are possible with the "
      "card's grains.");
}

}  // namespace pastefit
