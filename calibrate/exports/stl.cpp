#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>

#include "calibrate/base/input_file.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/application.h"

namespace pastefit {

namespace {

constexpr std::size_t kHeader = 84, kFacet = 50;  // bytes of a binary file before its triangles, and of a triangle

std::uint32_t count_in_binary(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
  return count;
}

/// An ASCII file may be as long as a binary one, but not of exactly the length that its bytes 80 to 83 promise.
bool is_binary(const std::string& bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * count_in_binary(bytes);
}

std::vector<Vec3> corners_of_binary(const std::string& bytes) {
  std::vector<Vec3> corners;
  for (std::uint32_t n = 0; n < count_in_binary(bytes); ++n)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      float at[3];
      std::memcpy(at, bytes.data() + kHeader + kFacet * n + 12 * (corner + 1), sizeof at);  // the normal comes first
      corners.push_back(vector_of(at));
    }
  return corners;
}

/// A corner that cannot be read is infinite.
std::vector<Vec3> corners_of_ascii(const std::string& text) {
  std::vector<Vec3> corners;
  std::istringstream words(text);
  words.imbue(std::locale::classic());
  for (std::string word; words >> word;) {
    if (small_letters(word) != "vertex") continue;
    Vec3 at;
    if (!(words >> at.x >> at.y >> at.z)) at.x = std::numeric_limits<double>::infinity();
    corners.push_back(at);
  }
  return corners;
}

bool is_possible(const Vec3& at) {
  constexpr double farthest_m = 1e4;  // NaN is not below it
  return std::fabs(at.x) < farthest_m && std::fabs(at.y) < farthest_m && std::fabs(at.z) < farthest_m;
}

}  // namespace

Result<std::vector<Triangle>> read_stl(const std::filesystem::path& file, double metres_per_unit) {
  constexpr std::string_view remedy = "an STL file, ASCII or binary";
  const auto content = read_input(file, {64u << 20, remedy, ".stl"});
  if (!content.ok()) return content.faults();
  const std::string& bytes = content.value();
  const std::vector<Vec3> corners = is_binary(bytes) ? corners_of_binary(bytes) : corners_of_ascii(bytes);
  std::vector<Triangle> triangles;
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    const Triangle one{metres_per_unit * corners[n], metres_per_unit * corners[n + 1],
                       metres_per_unit * corners[n + 2]};
    if (!std::ranges::all_of(one, is_possible))
      return Fault{file.string(),
                   "has a corner that is no point within 10 km, in triangle " + std::to_string(n / 3 + 1),
                   std::string(remedy)};
    if (norm(cross(one[1] - one[0], one[2] - one[0])) > 0) triangles.push_back(one);
  }
  if (triangles.empty() || corners.size() % 3 != 0)
    return Fault{file.string(), triangles.empty() ? "has no triangle" : "ends within a triangle", std::string(remedy)};
  return triangles;
}

std::string stl_text(const std::string& name, const std::vector<Triangle>& triangles) {
  std::string out = "solid " + name + "\n";
  for (const Triangle& one : triangles) {
    out += "facet normal 0 0 0\n outer loop\n";
    for (const Vec3& at : one) out += format("  vertex %.9g %.9g %.9g\n", at.x, at.y, at.z);
    out += " endloop\nendfacet\n";
  }
  return out + "endsolid " + name + "\n";
}

}  // namespace pastefit
