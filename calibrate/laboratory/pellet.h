#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/laboratory/default_answers.h"
#include "calibrate/laboratory/dimension_json.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/granule_test.h"
#include "core/apparatus/pellet_crush/pellet_crush.h"

namespace pastefit {

// The pellet crush in the words of files and people: what calibrate/laboratory/test.h asks of a kind, besides
// calibrate/laboratory/granule_test.h.

inline constexpr std::string_view kind_of(const PelletCrush&) {
  return "pellet";
}

/// The keys of "apparatus" in laboratory and apparatus files: millimetres and millimetres a second.
template <class Fields>
void describe_apparatus(Fields& apparatus, PelletCrush& test, Need need) {
  read_dimensions(apparatus, test, pellet_dimensions, need);
  read_tools(apparatus, "the surface of die, punch, platen and floor", test.tools);
}
std::vector<FilePlace> places_in_files(const PelletCrush&);

/// Of the punch and the platen.
double moved_time_s(const PelletCrush& test);

template <class Fields>
void describe_test(Fields& fields, PelletCrush& test) {
  describe_dimensions(fields, test, pellet_dimensions);
  describe_specimen(fields, test);
  fields.object({"tools", "surface of all tools"}, required, [&](auto& wall) { describe_wall(wall, test.tools); });
}

nlohmann::ordered_json conditions_of(const PelletCrush& test);
std::string conditions_in_words(const PelletCrush& test);

/// The stress on the platen over the strain of the pellet, over the strength that was measured.
std::vector<Drawing> drawings_of(const PelletCrush& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// Pellets whose stress still rose when the platen stopped. A line, or nothing.
std::string remarks_on(const PelletCrush& test, std::span<const Readings> runs);

}  // namespace pastefit
