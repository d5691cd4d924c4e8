#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/apparatus/field_checker.h"

namespace pastefit {

/// A number of an apparatus, described once. From its row follow its range, its key in JSON and in files for people,
/// the place of its faults, and what the schemas of data/schema say of it.
template <class Owner>
struct Dimension {
  std::string_view field;  ///< its name in SI, which ends with its unit: "base_radius_m"
  double Owner::*value;
  double smallest, largest;  ///< admissible, in SI
  std::string_view meaning;  ///< as files explain it
  bool has_default = false;  ///< files may leave it out
  /// It moves the readings, and reports of such tests often leave it out.
  bool often_unstated = false;
};

/// "m/s" of "lift_velocity_m_s"; empty if the name has no unit.
std::string_view unit_of_field(std::string_view field);

/// Faults of those out of range. `prefix`: of the fields of an inner object, "mould.".
template <class Owner, std::size_t count>
void check_dimensions(FieldChecker& check, const Owner& owner, const std::array<Dimension<Owner>, count>& dimensions,
                      const std::string& prefix = "") {
  for (const Dimension<Owner>& one : dimensions)
    check.range(prefix + std::string(one.field), owner.*one.value, one.smallest, one.largest, unit_of_field(one.field));
}

/// Of every surface of an apparatus.
inline constexpr std::array<Dimension<WallContact>, 4> surface_dimensions{{
    {"restitution", &WallContact::restitution, 0.001, 1, "rebound speed over impact speed, without attraction", true},
    {"friction", &WallContact::friction, 0, 10, "sliding friction of granules on it", true},
    {"rolling_friction", &WallContact::rolling_friction, 0, 10, "rolling friction of granules on it", true},
    {"cohesion_factor", &WallContact::cohesion_factor, 0, 10, "share of the granules' attraction that acts on it",
     true},
}};

}  // namespace pastefit
