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
#include "core/apparatus/pellet_crush/pellet_crush.h"

namespace pastefit {

// Pellet crush in files and messages: implements calibrate/laboratory/test.h, together with
// calibrate/laboratory/granule_test.h.

inline constexpr std::string_view kind_of(const PelletCrush&) {
  return "pellet";
}

void describe_apparatus(auto& apparatus, PelletCrush& test, Need need) {
  read_dimensions(apparatus, test, pellet_dimensions, need);
  read_tools(apparatus, "surface of the tools: die, punch, platen and floor; or plates, ribs and sides", test.tools);
}
std::vector<FilePlace> places_in_files(const PelletCrush&);

double moved_time_s(const PelletCrush& test);

void describe_test(auto& fields, PelletCrush& test) {
  describe_dimensions(fields, test, pellet_dimensions);
  describe_specimen(fields, test);
  fields.object({"tools", "surface of all tools"}, required, [&](auto& wall) { describe_wall(wall, test.tools); });
}

nlohmann::ordered_json conditions_of(const PelletCrush& test);
std::string conditions_in_words(const PelletCrush& test);

/// Stress on the platen over strain of the pellet, with the measured strength.
std::vector<Drawing> drawings_of(const PelletCrush& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// One-line remark on pellets whose stress still rose when the platen stopped; may be empty.
std::string remarks_on(const PelletCrush& test, std::span<const Readings> runs);

}  // namespace pastefit
