#pragma once

#include <algorithm>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/default_answers.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/specimen_json.h"
#include "calibrate/laboratory/yield_stress.h"
#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/ruler.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

// Slump test in files and messages: implements calibrate/laboratory/test.h.

inline constexpr std::string_view kind_of(const SlumpTest&) {
  return "slump";
}

inline std::vector<Surface> surfaces_of(SlumpTest& test) {
  return {{"mould", test.mould_wall}, {"table", test.table_wall}};
}

/// Pours the grains into the mould. Tests of one laboratory file with the same seed and key share the packing.
inline std::shared_ptr<const Packing> prepare(const SlumpTest& test, const RunOptions& options) {
  return fill_mould(test, options);
}
std::string preparation_key(const SlumpTest& test);

inline constexpr std::array<Named<HeightReading>, 2> height_readings{
    {{"axis", HeightReading::axis}, {"highest", HeightReading::highest}}};
inline constexpr std::array<Named<TableMotion>, 2> table_motions{
    {{"hinged", TableMotion::hinged}, {"vertical", TableMotion::vertical}}};

template <class Fields>
void describe_apparatus(Fields& apparatus, SlumpTest& test, Need need) {
  apparatus.object({"mould", "the mould, a frustum that is open at both ends"}, need,
                   [&](auto& mould) { read_dimensions(mould, test.mould, mould_dimensions, need); });
  read_dimensions(apparatus, test, slump_dimensions, need);
  const bool has_plate = test.drop || (!Fields::reads && need == Need::optional);
  const Need plate_need = has_plate ? Need::optional : Need::required;
  apparatus.nullable_object(
      {"drop_plate",
       "the plate or table that is dropped in step 2 and in all later drops; null: the test ends with step 1"},
      test.drop, Need::optional, [&](auto& plate, DropPlate& drop) {
        plate.choice({"motion",
                      "hinged: a square plate rotates up about one edge and falls back (EN 12350-5); vertical: a round "
                      "table falls vertically (EN 1015-3, ASTM C230); default hinged"},
                     drop.motion, table_motions, Need::optional);
        if constexpr (Fields::reads)
          if (drop.motion == TableMotion::vertical)
            plate.refuse("lift_duration_s",
                         "is of a hinged plate: a cam raises a table so slowly that it takes no simulated time",
                         "leave it out");
        read_dimensions(plate, drop, plate_dimensions, plate_need);
        plate.integer({"drops", "number of drops; with the default, 1, the test ends with step 2"}, drop.drops, 1,
                      kMostDrops, Need::optional);
        read_dimensions(plate, drop, rhythm_dimensions, Need::optional);
      });
  apparatus.nullable_object({"tilt",
                             "tilting of the table after step 1, until the heap slides; null or left out: no tilting, "
                             "unless the angle of sliding is among the readings"},
                            test.tilt, Need::optional,
                            [&](auto& tilt, Tilt& motion) { read_dimensions(tilt, motion, tilt_dimensions, need); });
  apparatus.object({"reading", "how the heap is measured"}, need, [&](auto& reading) {
    reading.choice({"height",
                    "point whose height is read; axis: the displaced centre of the struck-off top (ASTM C143); "
                    "highest: the highest point (EN 12350-2)"},
                   test.reading.height, height_readings, need);
    read_dimensions(reading, test.reading, reading_dimensions, need);
    reading.nullable_object({"flow",
                             "timing of the flow from the beginning of the lift; null or left out: no timing, unless a "
                             "time is among the readings"},
                            test.reading.flow, Need::optional, [&](auto& flow, FlowTiming& timing) {
                              read_dimensions(flow, timing, flow_dimensions, need);
                            });
    reading.nullable_object({"flank",
                             "part of the flank on which the angle of repose after step 1 is read; null or left out: "
                             "not read, unless the angle is among the readings"},
                            test.reading.flank, Need::optional, [&](auto& flank, Flank& shares) {
                              read_dimensions(flank, shares, flank_dimensions, need);
                            });
  });
}

void read_outline(ObjectReader& reader, const ReadingKind& kind, SlumpTest& test);

void ask_for(SlumpTest& test, const ReadingKind& kind);

std::vector<FilePlace> places_in_files(const SlumpTest&);

double moved_time_s(const SlumpTest& test);

/// In SI, with the unit in each key. Keys without a default are required.
void describe_test(auto& fields, SlumpTest& test) {
  fields.object({"mould", "the mould, a frustum that is open at both ends"}, required,
                [&](auto& mould) { describe_dimensions(mould, test.mould, mould_dimensions); });
  describe_dimensions(fields, test, slump_dimensions);
  fields.nullable_object(
      {"drop", "the plate or table that is dropped in step 2 and in all later drops; null: the test ends with step 1"},
      test.drop, required, [](auto& drop, auto& plate) {
        const DropPlate usual;
        describe_dimensions(drop, plate, plate_dimensions);
        drop.choice({"motion", "motion of the plate, as in laboratory files; default hinged"}, plate.motion,
                    table_motions, Default{usual.motion});
        drop.integer({"drops", "number of drops; default 1"}, plate.drops, 1, kMostDrops, Default{usual.drops});
        drop.number({"period_s", "time from one drop to the next, if there are several; default 2"}, plate.period_s,
                    any_number, Default{usual.period_s});
      });
  fields.optional_object({"tilt", "tilting of the table after step 1, until the heap slides"}, test.tilt,
                         [](auto& tilt, auto& motion) { describe_dimensions(tilt, motion, tilt_dimensions); });
  fields.object({"reading", "how the heap is measured"}, required, [&](auto& reading) {
    reading.choice({"height", "point whose height is read, as in laboratory files"}, test.reading.height,
                   height_readings, required);
    describe_dimensions(reading, test.reading, reading_dimensions);
    reading.pairs({"spread_curve_s_m", "measured points [time in s, spread in m]"}, test.reading.spread_curve,
                  any_number, any_number, Need::optional, 0);
    reading.optional_object({"flow", "timing of the flow from the beginning of the lift"}, test.reading.flow,
                            [](auto& flow, auto& timing) { describe_dimensions(flow, timing, flow_dimensions); });
    reading.optional_object({"flank", "part of the flank on which the angle of repose after step 1 is read"},
                            test.reading.flank,
                            [](auto& flank, auto& shares) { describe_dimensions(flank, shares, flank_dimensions); });
    reading.pairs({"outline_step1_m", "measured outline after step 1, points [x, z]"}, test.reading.outline_step1,
                  any_number, any_number, Need::optional, 0);
    reading.pairs({"outline_step2_m", "measured outline after step 2, points [x, z]"}, test.reading.outline_step2,
                  any_number, any_number, Need::optional, 0);
  });
  describe_specimen(fields, test);
  fields.object({"mould_wall", "surface of the mould"}, required,
                [&](auto& wall) { describe_wall(wall, test.mould_wall); });
  fields.object({"table_wall", "surface of the table"}, required,
                [&](auto& wall) { describe_wall(wall, test.table_wall); });
}

inline SlumpTest default_test(const SlumpTest&) {
  SlumpTest test;
  test.drop.emplace();
  return test;
}

/// Density of a grain for which the mould has the measured bulk density.
std::optional<double> grain_density_of(const SlumpTest& test, const Readings& means);

/// Nothing from the second drop of one heap on (`Snapshot::drop` > 0).
std::optional<Outline> heap_at(const SlumpTest& test, const Snapshot& snapshot);

/// Side view of the heap after each step, in millimetres (calibrate/laboratory/slump_drawing.cpp).
std::vector<Drawing> drawings_of(const SlumpTest& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured);

/// One standard deviation of the measurement, but at least half a grain's radius, the roughness of a heap's surface.
/// For the shift of the top: the limit of sheared-off heaps.
double default_tolerance(const SlumpTest& test, const Measurement& measured);

/// Diameter of the narrower end of the mould, or its height if that is less.
inline std::optional<double> narrowest_opening_m(const SlumpTest& test) {
  return std::min(2 * narrower_radius_m(test.mould), test.mould.height_m);
}

/// The height alone does not identify friction and strength; friction affects the width.
std::string unseen_by(const SlumpTest& test, std::span<const std::string_view> readings,
                      std::span<const std::string_view> parameters);

/// From fresh foams to heavy concretes, from a small tube to the cone for dam concrete.
inline std::vector<Experience> experience_of(const SlumpTest& test) {
  return {{"material.bulk_density_kg_m3", test.bulk_density_kg_m3, 400, 5000},
          {"apparatus.mould.height_mm", mm * test.mould.height_m, 40, 600}};
}

/// Conditions for which a fit in this test is valid, for cards, and as text.
nlohmann::ordered_json conditions_of(const SlumpTest& test);
std::string conditions_in_words(const SlumpTest& test);

/// Shift of the top (`shear_index`): EN 12350-2 and ASTM C143 require tests of sheared-off heaps to be repeated.
inline std::optional<double> rejection_index(const SlumpTest& test, const Readings& run) {
  return shear_index(test, run);
}

inline std::string_view rejected_runs(const SlumpTest&) {
  return "heaps sheared off";
}

std::string remarks_on(const SlumpTest& test, std::span<const Readings> runs);

// Checks of the readings (calibrate/laboratory/heap_shape.cpp).

/// Width of a cone of this height with the volume of the mould: 2 sqrt(3 V/(pi h)). Requirement: height > 0.
double cone_width_mm(const SlumpTest& test, double height_mm);

/// True for the table of ASTM C230, which drops by half an inch. Its flow is the increase of the width over the mould's
/// base, in per cent (ASTM C1437).
bool gives_flow_in_percent(const SlumpTest& test);

/// Width [mm] for a flow in per cent.
inline double width_of_flow_mm(const SlumpTest& test, double percent) {
  return 2e3 * test.mould.base_radius_m * (1 + percent / 100);
}

/// Checks heights against widths of the same heap by the share s, the measured width over that of the cone of the same
/// height and volume:
///     pancake 1/sqrt(3) = 0.58, paraboloid sqrt(2/3) = 0.82, cone 1.
/// No convex heap is wider than the cone, but one with a skirt is: s > 1 by more than the deviations is a doubt. No
/// heap is narrower than the pancake: s < 0.58 is a doubt with likely mistakes, and 3 deviations below it a fault. With
/// s ~ D sqrt(h), the deviations of the means give the deviation s sqrt((s_D/D)^2 + (s_h/2h)^2). Other heaps are a
/// note. Further doubts: a slump of a few millimetres, or a width that may be a flow in per cent, because of a possible
/// wrong unit; readings after the first of several drops without those after all of them. Further fault: a time to a
/// width that the heap does not reach, by more than the deviation of its width. Limits: the heap has the volume of the
/// mould, nothing has flowed off the table, and its height is at or near its highest point.
ReadingCheck check_readings(const SlumpTest& test, std::span<const Measurement> measurements);

/// Adds a fault for each outline or spread curve in a frame or unit other than that of files: measured from a picture's
/// edge, downwards, in centimetres, or as a radius.
void check_curves(const SlumpTest& test, ReadingCheck& check);

}  // namespace pastefit
