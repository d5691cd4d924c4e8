#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/apparatus/field_checker.h"

namespace pastefit {

/// One numerical field of an apparatus. Its row gives the range check, the JSON key, the key in laboratory files, the
/// place named in error messages, and the entry in the schemas of data/schema.
template <class Owner>
struct Dimension {
  std::string_view field;  ///< SI name, ending with the unit: "base_radius_m"
  double Owner::*value;
  double smallest, largest;  ///< accepted range, in SI
  std::string_view meaning;  ///< explanation in files
  bool has_default = false;  ///< may be omitted in files
  /// It affects the readings, and reports of such tests often omit it.
  bool often_unstated = false;
};

/// Unit of a field name, "m/s" for "lift_velocity_m_s"; empty if the name has none.
std::string_view unit_of_field(std::string_view field);

/// Checks all ranges. `prefix`: path of an inner object, "mould.".
template <class Owner, std::size_t count>
void check_dimensions(FieldChecker& check, const Owner& owner, const std::array<Dimension<Owner>, count>& dimensions,
                      const std::string& prefix = "") {
  for (const Dimension<Owner>& one : dimensions)
    check.range(prefix + std::string(one.field), owner.*one.value, one.smallest, one.largest, unit_of_field(one.field));
}

/// The dimensions of every surface of an apparatus.
inline constexpr std::array<Dimension<WallContact>, 4> surface_dimensions{{
    {"restitution", &WallContact::restitution, 0.001, 1, "rebound speed divided by impact speed, without attraction",
     true},
    {"friction", &WallContact::friction, 0, 10, "sliding friction of grains on this surface", true},
    {"rolling_friction", &WallContact::rolling_friction, 0, 10, "rolling friction of grains on this surface", true},
    {"cohesion_factor", &WallContact::cohesion_factor, 0, 10,
     "share of the grains' attraction that acts on this surface", true},
}};

}  // namespace pastefit
