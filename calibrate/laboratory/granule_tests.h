#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/laboratory/default_answers.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/specimen_json.h"
#include "core/apparatus/pellet_crush/pellet_crush.h"
#include "core/apparatus/shear_cell/shear_cell.h"

namespace pastefit {

// Tests of small adhesive granules (core/apparatus/granules.h), pellet crush and shear cell, in files and messages:
// implements calibrate/laboratory/test.h.

inline constexpr std::string_view kind_of(const PelletCrush&) {
  return "pellet";
}
inline constexpr std::string_view kind_of(const ShearCell&) {
  return "shear";
}

inline double moved_time_s(const PelletCrush& test) {
  return (test.fill_height_m - test.pressed_height_m) / (test.punch_speed_m_s * test.press_speedup) +
         test.final_strain * test.pressed_height_m / test.platen_speed_m_s;
}
inline double moved_time_s(const ShearCell& test) {
  return test.final_displacement_m / (test.shear_speed_m_s * test.shear_speedup);
}

/// Surface of the tools in laboratory and apparatus files.
void read_tools(auto& apparatus, WallContact& tools) {
  apparatus.object({"tools", "surface of the tools: die, punch, platen and floor; or plates, ribs and sides"},
                   Need::optional,
                   [&](auto& fields) { read_dimensions(fields, tools, surface_dimensions, Need::optional); });
}

void describe_tools(auto& fields, auto& tools) {
  fields.object({"tools", "surface of all tools"}, required, [&](auto& wall) { describe_wall(wall, tools); });
}

/// `describe(fields, ribs)`: dimensions of the ribs of a plate.
void describe_ribs(auto& fields, ShearCell& test, Need need, auto describe) {
  fields.object({"lid_ribs", "ribs of the upper plate, the lid"}, need,
                [&](auto& inner) { describe(inner, test.lid_ribs); });
  fields.object({"base_ribs", "ribs of the lower plate, the base"}, need,
                [&](auto& inner) { describe(inner, test.base_ribs); });
}

void describe_apparatus(auto& apparatus, PelletCrush& test, Need need) {
  read_dimensions(apparatus, test, pellet_dimensions, need);
  read_tools(apparatus, test.tools);
}

void describe_apparatus(auto& apparatus, ShearCell& test, Need need) {
  read_dimensions(apparatus, test, shear_dimensions, need);
  describe_ribs(apparatus, test, need,
                [need](auto& fields, auto& ribs) { read_dimensions(fields, ribs, rib_dimensions, need); });
  read_tools(apparatus, test.tools);
}

inline std::vector<FilePlace> places_in_files(const PelletCrush&) {
  std::vector<FilePlace> places;
  add_places(places, pellet_dimensions);
  add_places(places, surface_dimensions, "tools", "apparatus.tools");
  return places;
}
inline std::vector<FilePlace> places_in_files(const ShearCell&) {
  std::vector<FilePlace> places;
  add_places(places, shear_dimensions);
  add_places(places, rib_dimensions, "lid_ribs", "apparatus.lid_ribs");
  add_places(places, rib_dimensions, "base_ribs", "apparatus.base_ribs");
  add_places(places, surface_dimensions, "tools", "apparatus.tools");
  return places;
}

void describe_test(auto& fields, PelletCrush& test) {
  describe_dimensions(fields, test, pellet_dimensions);
  describe_specimen(fields, test);
  describe_tools(fields, test.tools);
}

void describe_test(auto& fields, ShearCell& test) {
  describe_dimensions(fields, test, shear_dimensions);
  describe_ribs(fields, test, required,
                [](auto& inner, auto& ribs) { describe_dimensions(inner, ribs, rib_dimensions); });
  describe_specimen(fields, test);
  describe_tools(fields, test.tools);
}

nlohmann::ordered_json conditions_of(const PelletCrush& test);
nlohmann::ordered_json conditions_of(const ShearCell& test);
std::string conditions_in_words(const PelletCrush& test);
std::string conditions_in_words(const ShearCell& test);

/// Stress on the platen over strain of the pellet, with the measured strength.
std::vector<Drawing> drawings_of(const PelletCrush& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);
/// Shear stress on the lid over displacement of the base, with the measured stress.
std::vector<Drawing> drawings_of(const ShearCell& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// One-line remark on pellets whose stress still rose when the platen stopped; may be empty.
std::string remarks_on(const PelletCrush& test, std::span<const Readings> runs);
/// One-line remark on beds whose stress still changed when the base stopped; may be empty.
std::string remarks_on(const ShearCell& test, std::span<const Readings> runs);

}  // namespace pastefit
