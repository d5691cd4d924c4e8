#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/base/object_schema.h"
#include "core/laws/materials.h"
#include "core/result.h"
#include "core/vec3.h"

namespace pastefit {

// A machine for the material of a card: what is fed into it, the surfaces that it meets, and what is asked of it.

/// Straight motion over a distance, e.g. of a gate.
struct Slide {
  double from_s = 0;
  Vec3 velocity_m_s;
  double distance_m = 0;

  double until_s() const { return from_s + distance_m / norm(velocity_m_s); }
};

/// Rotation about a fixed axis, by the right-hand rule.
struct Rotation {
  double from_s = 0;
  Vec3 point_m, axis;  ///< `axis`: not zero
  double revolutions_per_min = 0;
};

using Triangle = std::array<Vec3, 3>;

/// Surface of one material, from an STL file.
struct MachinePart {
  std::string name;
  std::string file;            ///< relative to the application file
  bool in_metres = false;      ///< unit of the STL file: metres, otherwise millimetres
  WallContact contact;         ///< default: that of the card's table
  std::optional<Slide> slide;  ///< a part slides or rotates, or neither
  std::optional<Rotation> rotation;
  std::vector<Triangle> triangles;  ///< [m]
};

/// Stream of grains from a disc across its velocity.
struct Feed {
  Vec3 centre_m, velocity_m_s;
  double radius_m = 0, mass_kg = 0, rate_kg_s = 0;
};

/// Plane; its normal points away from the machine, or from the floor.
struct OrientedPlane {
  Vec3 point_m, normal;
};

/// Place at which the depth of the flow is measured: grains within `radius_m` of the point, along the floor.
struct DepthGauge {
  OrientedPlane floor;
  double radius_m = 0;
};

struct Application {
  std::string title;
  std::vector<MachinePart> parts;
  Feed feed;
  std::optional<OrientedPlane> outlet;  ///< grains beyond it are discharged
  std::optional<DepthGauge> depth;
  double duration_s = 0;

  /// Start of the last motion, from which times are counted; 0 if nothing moves.
  double start_s() const;
  /// Smallest box that holds parts, with the way of those that slide, and feed.
  std::pair<Vec3, Vec3> bounds() const;
};

/// Reads a file ("format": "pastefit-application-1") and its STL files. A name without a suffix, if there is no such
/// file, is that of a shipped machine: "chute" is `applications/chute.json` of the program's data. `usual`: surface of
/// parts whose properties the file does not give. Errors: every fault, with its place.
Result<Application> read_application(const std::filesystem::path& file, const WallContact& usual);

/// Estimated time from the feed of a grain to its discharge, averaged over the fed grains. Without an outlet: until the
/// end. With an outlet and a motion, e.g. of a gate: grains leave evenly from the last start of a motion to the end.
/// Otherwise twice the free fall from the feed to the height of the outlet, because surfaces slow the grains. Limit:
/// not for material that stays in a machine with an outlet.
double mean_residence_s(const Application& application);

/// Largest velocity of the feed and of the parts' corners.
double fastest_m_s(const Application& application);

/// Faults of an application with grains of this largest radius and density: a feed too narrow for the grains or for its
/// rate, and too few or too many grains.
Faults unsuitable_grains(const Application& application, double largest_radius_m, double grain_density_kg_m3);

ObjectSchema::Json application_schema();

/// Reads the triangles of an STL file, ASCII or binary, with lengths times `metres_per_unit`, since STL has no unit.
/// Triangles without an area are left out: LIGGGHTS refuses them. Errors: the file is unreadable or no STL; a
/// corner cannot be read or lies beyond 10 km; no triangle is left. Source of the format: StereoLithography Interface
/// Specification, 3D Systems (1989).
Result<std::vector<Triangle>> read_stl(const std::filesystem::path& file, double metres_per_unit);

/// ASCII STL. Normals are 0: readers compute them from the corners.
std::string stl_text(const std::string& name, const std::vector<Triangle>& triangles);

}  // namespace pastefit
