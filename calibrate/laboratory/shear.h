#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/laboratory/default_answers.h"
#include "calibrate/laboratory/dimension_json.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/granule_test.h"
#include "core/apparatus/shear_cell/shear_cell.h"

namespace pastefit {

// Shear cell in files and messages: implements calibrate/laboratory/test.h, together with
// calibrate/laboratory/granule_test.h.

inline constexpr std::string_view kind_of(const ShearCell&) {
  return "shear";
}

void describe_apparatus(auto& apparatus, ShearCell& test, Need need) {
  read_dimensions(apparatus, test, shear_dimensions, need);
  const auto ribs = [need](auto* own) {
    return [own, need](auto& fields) { read_dimensions(fields, *own, rib_dimensions, need); };
  };
  apparatus.object({"lid_ribs", "ribs of the upper plate, the lid"}, need, ribs(&test.lid_ribs));
  apparatus.object({"base_ribs", "ribs of the lower plate, the base"}, need, ribs(&test.base_ribs));
  read_tools(apparatus, "surface of the tools: die, punch, platen and floor; or plates, ribs and sides", test.tools);
}
std::vector<FilePlace> places_in_files(const ShearCell&);

double moved_time_s(const ShearCell& test);

void describe_test(auto& fields, ShearCell& test) {
  describe_dimensions(fields, test, shear_dimensions);
  const auto ribs = [](auto* own) { return [own](auto& inner) { describe_dimensions(inner, *own, rib_dimensions); }; };
  fields.object({"lid_ribs", "ribs of the upper plate, the lid"}, required, ribs(&test.lid_ribs));
  fields.object({"base_ribs", "ribs of the lower plate, the base"}, required, ribs(&test.base_ribs));
  describe_specimen(fields, test);
  fields.object({"tools", "surface of all tools"}, required, [&](auto& wall) { describe_wall(wall, test.tools); });
}

nlohmann::ordered_json conditions_of(const ShearCell& test);
std::string conditions_in_words(const ShearCell& test);

/// Shear stress on the lid over displacement of the base, with the measured stress.
std::vector<Drawing> drawings_of(const ShearCell& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// One-line remark on beds whose stress still changed when the base stopped; may be empty.
std::string remarks_on(const ShearCell& test, std::span<const Readings> runs);

}  // namespace pastefit
