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

// The pellet crush in the words of files and people: what `LaboratoryTest` (calibrate/laboratory/test.h) asks of a
// kind, besides calibrate/laboratory/granule_test.h.

inline constexpr std::string_view kind_of(const PelletCrush&) {
  return "pellet";
}

/// The keys of "apparatus" in laboratory and apparatus files: millimetres and millimetres a second.
void read_apparatus(ObjectReader& apparatus, PelletCrush& test, Need need);
void tell_apparatus(ObjectSchema& schema, PelletCrush any, Need need);
std::vector<FilePlace> places_in_files(const PelletCrush&);

/// Of the punch and the platen.
double moved_time_s(const PelletCrush& test);

nlohmann::json to_json(const PelletCrush& test);
PelletCrush default_test(const PelletCrush&);
void read_test(ObjectReader& reader, PelletCrush& test);
void tell_schema(ObjectSchema& schema, PelletCrush any);

nlohmann::ordered_json conditions_of(const PelletCrush& test);
std::string conditions_in_words(const PelletCrush& test);

/// The stress on the platen over the strain of the pellet, over the strength that was measured.
std::vector<Drawing> drawings_of(const PelletCrush& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// Pellets whose stress still rose when the platen stopped. A line, or nothing.
std::string remarks_on(const PelletCrush& test, std::span<const Readings> runs);

}  // namespace pastefit
