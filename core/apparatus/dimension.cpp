#include "core/apparatus/dimension.h"

#include <utility>

namespace pastefit {

std::string_view unit_of_field(std::string_view field) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> units{{{"_m_s", "m/s"},
                                                                                       {"_deg_s", "degrees/s"},
                                                                                       {"_m", "m"},
                                                                                       {"_kg", "kg"},
                                                                                       {"_s", "s"},
                                                                                       {"_pa", "Pa"},
                                                                                       {"_rad", "rad"}}};
  for (const auto& [end, unit] : units)
    if (field.ends_with(end)) return unit;
  return {};
}

}  // namespace pastefit
