#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/laboratory/default_answers.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/specimen_json.h"
#include "core/apparatus/drop_test/drop_test.h"

namespace pastefit {

// Drop test in files and messages: implements calibrate/laboratory/test.h.

inline constexpr std::string_view kind_of(const DropTest&) {
  return "drop";
}

inline double grains_needed(const DropTest&) {
  return 1;
}

void describe_apparatus(auto& apparatus, DropTest& test, Need need) {
  read_dimensions(apparatus, test, drop_dimensions, need);
}
inline std::vector<FilePlace> places_in_files(const DropTest&) {
  std::vector<FilePlace> places;
  add_places(places, drop_dimensions);
  return places;
}

void describe_test(auto& fields, DropTest& test) {
  describe_dimensions(fields, test, drop_dimensions);
  describe_specimen(fields, test);
}

inline DropTest default_test(const DropTest&) {
  DropTest test;
  test.plate_tilt_rad = 0.5;
  return test;
}

inline std::string_view why_of_that_size(const DropTest&) {
  return "the ball of a drop test is one grain, as large as the laboratory's";
}

nlohmann::ordered_json conditions_of(const DropTest& test);
std::string conditions_in_words(const DropTest& test);

/// Height of the ball over time, from the fall to the top of the rebound, on each plate. Free flight before and after
/// the contact, which is too short to be drawn.
std::vector<Drawing> drawings_of(const DropTest& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

}  // namespace pastefit
