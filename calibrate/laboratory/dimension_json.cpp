#include "calibrate/laboratory/dimension_json.h"

#include "calibrate/base/units.h"

namespace pastefit {

FileKey file_key(std::string_view field) {
  struct Ending {
    std::string_view in_si, in_files;
    double per_si;
  };
  static constexpr std::array<Ending, 4> endings{
      {{"_radius_m", "_diameter_mm", 2 * mm}, {"_m_s", "_mm_s", mm}, {"_m", "_mm", mm}, {"_rad", "_deg", degrees}}};
  for (const Ending& end : endings)
    if (field.ends_with(end.in_si))
      return {std::string(field.substr(0, field.size() - end.in_si.size())) + std::string(end.in_files), end.per_si};
  return {std::string(field)};
}

}  // namespace pastefit
