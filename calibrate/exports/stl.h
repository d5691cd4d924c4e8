#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec3.h"

namespace pastefit {

using Triangle = std::array<Vec3, 3>;

/// Reads the triangles of an STL file, ASCII or binary, with lengths times `metres_per_unit`, since STL has no unit.
/// Triangles without an area are left out: LIGGGHTS refuses them. Errors: the file is unreadable or no STL; a
/// corner cannot be read or lies beyond 10 km; no triangle is left. Source of the format: StereoLithography Interface
/// Specification, 3D Systems (1989).
Result<std::vector<Triangle>> read_stl(const std::filesystem::path& file, double metres_per_unit);

/// ASCII STL. Normals are 0: readers compute them from the corners.
std::string stl_text(const std::string& name, const std::vector<Triangle>& triangles);

}  // namespace pastefit
