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
#include "core/apparatus/shear_cell/shear_cell.h"

namespace pastefit {

// The shear cell in the words of files and people: what `LaboratoryTest` (calibrate/laboratory/test.h) asks of a kind,
// besides calibrate/laboratory/granule_test.h.

inline constexpr std::string_view kind_of(const ShearCell&) {
  return "shear";
}

/// The keys of "apparatus" in laboratory and apparatus files: millimetres and millimetres a second.
void read_apparatus(ObjectReader& apparatus, ShearCell& test, Need need);
void tell_apparatus(ObjectSchema& schema, ShearCell any, Need need);
std::vector<FilePlace> places_in_files(const ShearCell&);

/// Of the base.
double moved_time_s(const ShearCell& test);

nlohmann::json to_json(const ShearCell& test);
ShearCell default_test(const ShearCell&);
void read_test(ObjectReader& reader, ShearCell& test);
void tell_schema(ObjectSchema& schema, ShearCell any);

nlohmann::ordered_json conditions_of(const ShearCell& test);
std::string conditions_in_words(const ShearCell& test);

/// The stress that drags the lid along over the displacement of the base, over the stress that was measured.
std::vector<Drawing> drawings_of(const ShearCell& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// Beds whose stress still changed when the base stopped. A line, or nothing.
std::string remarks_on(const ShearCell& test, std::span<const Readings> runs);

}  // namespace pastefit
