#include <algorithm>

#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

namespace {

constexpr double kLongestFlow = 600;  // [s] longest simulated flow time
constexpr double room = 0.02;         // margin for the accuracy of the apparatus

constexpr std::string_view highest_is_above = "the highest point of a heap is not below its height";
constexpr std::string_view not_raised = "a drop does not raise a heap";
constexpr std::string_view sags_within = "a top does not sag by more than the heap's height";
constexpr std::string_view not_drawn = "a drop does not draw a heap together";
constexpr std::string_view the_table =
    "that of the table: apparatus.table_length_mm, or apparatus.drop_plate.length_mm";
constexpr std::string_view published =
    "published for the slump: 21 mm as the 95 % limit between two results (ASTM C143-98), so about 7.5";
constexpr std::string_view published_spread =
    "published for slump flows of 480 to 680 mm: 27 mm of one operator (ASTM C1611)";
// Both for an Abrams cone; scaled to other moulds.
constexpr double published_mould_mm = 300, published_height_mm = 7.5, published_spread_mm = 27;
constexpr Lack no_plate{
    "the apparatus has no plate or table that drops",
    "leave it out, or describe the plate in apparatus.drop_plate; a width without drops is step1.spread_mm"};

constexpr Lack no_sides{"the table falls upright, so that its heap has no free side",
                        "leave it out, or say that the plate is \"hinged\" in apparatus.drop_plate.motion"};
constexpr Lack one_drop{
    "the plate is dropped once, so that there is only step 2",
    "give their number: 15 for EN 12350-5 (apparatus.drop_plate.drops, or --drops of pastefit new); the "
    "spread after a single drop is step2"};

/// Largest readings that mould and table allow.
struct SlumpRanges {
  explicit SlumpRanges(const SlumpTest& test)
      : mould_mm(1e3 * test.mould.height_m),
        base_mm(2e3 * test.mould.base_radius_m),
        table_mm(1e3 * test.table_length_m),
        full_kg(test.bulk_density_kg_m3 * volume_m3(test.mould)) {}

  double mould_mm, base_mm, table_mm, full_kg;
  double deviation_of_height = published_height_mm * (mould_mm / published_mould_mm);
  double deviation_of_spread = published_spread_mm * (mould_mm / published_mould_mm);
  ReadingRange mass{0.5 * full_kg, 1.5 * full_kg}, share{0, 1};
  ReadingRange height{0, (1 + room) * mould_mm}, slump{-room * mould_mm, mould_mm}, sag{-mould_mm, mould_mm};
  ReadingRange spread{(1 - room) * base_mm, std::max(table_mm, base_mm)}, on_the_table{0, table_mm};
};

// clang-format off
std::vector<ReadingKind> fill_kinds(const SlumpRanges& ranges) {
  return {
    ReadingKind{.name = "fill.mass_kg", .key = "fill.mass_kg", .measure = "fill.mass_kg", .stage = kFill,
                .possible = ranges.mass, .advised = true, .checked = true},
    ReadingKind{.name = "fill.solid_fraction", .key = "", .measure = "", .stage = kFill, .possible = ranges.share,
                .checked = true}};
}

std::vector<ReadingKind> step1_kinds(const SlumpRanges& ranges) {
  return {
    ReadingKind{.name = "step1.spilled_share", .key = "", .measure = "", .stage = kStep1, .possible = ranges.share},
    ReadingKind{.name = "step1.height_mm", .key = "step1.height_mm", .measure = "step1.height_mm", .stage = kStep1,
                .possible = ranges.height, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step1.height_max_mm", highest_is_above}}}, .advised = true, .ends_early = true,
                .repeatability = published, .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step1.slump_mm", .key = "step1.slump_mm", .measure = "step1.height_mm", .stage = kStep1,
                .possible = ranges.slump, .worst_miss = ranges.mould_mm, .less_than = ranges.mould_mm,
                .repeatability = published, .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step1.height_axis_mm", .key = "step1.height_axis_mm", .measure = "step1.height_axis_mm",
                .stage = kStep1, .possible = ranges.height, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step1.height_max_mm", highest_is_above}}}, .checked = true, .repeatability = published,
                .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step1.height_max_mm", .key = "step1.height_max_mm", .measure = "step1.height_max_mm",
                .stage = kStep1, .possible = ranges.height, .worst_miss = ranges.mould_mm, .advised = true,
                .checked = true, .repeatability = published, .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step1.lateral_shift_mm", .key = "step1.lateral_shift_mm", .measure = "step1.lateral_shift_mm",
                .stage = kStep1, .possible = ranges.on_the_table, .worst_miss = ranges.mould_mm},
    ReadingKind{.name = "step1.spread_mm", .key = "step1.spread_mm", .measure = "step1.spread_mm", .stage = kStep1,
                .possible = ranges.spread, .bounded_by = the_table, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step2.spread_mm", not_drawn}, {"after_drops.spread_mm", not_drawn}}}, .advised = true,
                .checked = true,
                .repeatability = published_spread, .published_deviation = ranges.deviation_of_spread},
    ReadingKind{.name = "step1.spread_orthogonal_mm", .key = "step1.spread_orthogonal_mm",
                .measure = "step1.spread_orthogonal_mm", .stage = kStep1, .possible = ranges.spread, .bounded_by = the_table,
                .worst_miss = ranges.mould_mm, .repeatability = published_spread,
                .published_deviation = ranges.deviation_of_spread},
    ReadingKind{.name = "step1.profile_mm", .key = "step1.profile", .measure = "step1.profile_mm", .stage = kStep1,
                .possible = ranges.on_the_table, .worst_miss = ranges.mould_mm, .from_outline = true},
    ReadingKind{.name = "step1.t500_s", .key = "step1.t500_s", .measure = "step1.t500_s", .stage = kStep1,
                .possible = {0, kLongestFlow}, .worst_miss = kLongestFlow, .on_request = true,
                .depends_on = "apparatus.lift_velocity_mm_s"},
    ReadingKind{.name = "step1.flow_time_s", .key = "step1.flow_time_s", .measure = "step1.flow_time_s",
                .stage = kStep1, .possible = {0, kLongestFlow}, .worst_miss = kLongestFlow, .on_request = true,
                .depends_on = "apparatus.lift_velocity_mm_s"},
    ReadingKind{.name = "step1.spread_curve_mm", .key = "step1.spread_curve", .measure = "step1.spread_curve_mm",
                .stage = kStep1, .possible = ranges.on_the_table, .worst_miss = ranges.table_mm, .from_outline = true,
                .depends_on = "apparatus.lift_velocity_mm_s"},
    ReadingKind{.name = "step1.angle_of_repose_deg", .key = "step1.angle_of_repose_deg",
                .measure = "step1.angle_of_repose_deg", .stage = kStep1, .possible = {0, 90}, .worst_miss = 90,
                .on_request = true, .depends_on = "apparatus.lift_velocity_mm_s"}};
}

std::vector<ReadingKind> step2_kinds(const SlumpRanges& ranges) {
  return {
    ReadingKind{.name = "step2.spilled_share", .key = "", .measure = "", .stage = kStep2, .possible = ranges.share},
    ReadingKind{.name = "step2.height_mm", .key = "step2.height_mm", .measure = "step2.height_mm", .stage = kStep2,
                .possible = ranges.height, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step2.height_max_mm", highest_is_above}, {"step1.height_mm", not_raised}}},
                .advised = true, .repeatability = published, .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step2.slump_mm", .key = "step2.slump_mm", .measure = "step2.height_mm", .stage = kStep2,
                .possible = ranges.slump, .worst_miss = ranges.mould_mm, .less_than = ranges.mould_mm,
                .repeatability = published, .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step2.height_axis_mm", .key = "step2.height_axis_mm", .measure = "step2.height_axis_mm",
                .stage = kStep2, .possible = ranges.height, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step2.height_max_mm", highest_is_above}}}, .checked = true, .repeatability = published,
                .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step2.height_max_mm", .key = "step2.height_max_mm", .measure = "step2.height_max_mm",
                .stage = kStep2, .possible = ranges.height, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step1.height_max_mm", not_raised}}}, .advised = true, .checked = true,
                .repeatability = published, .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "step2.lateral_shift_mm", .key = "", .measure = "", .stage = kStep2,
                .possible = ranges.on_the_table, .worst_miss = ranges.mould_mm},
    ReadingKind{.name = "step2.spread_mm", .key = "step2.spread_mm", .measure = "step2.spread_mm", .stage = kStep2,
                .possible = ranges.spread, .bounded_by = the_table, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"after_drops.spread_mm", not_drawn}}}, .advised = true, .checked = true,
                .repeatability = published_spread, .published_deviation = ranges.deviation_of_spread},
    ReadingKind{.name = "step2.spread_orthogonal_mm", .key = "step2.spread_orthogonal_mm",
                .measure = "step2.spread_orthogonal_mm", .stage = kStep2, .possible = ranges.spread, .bounded_by = the_table,
                .worst_miss = ranges.mould_mm, .repeatability = published_spread,
                .published_deviation = ranges.deviation_of_spread},
    ReadingKind{.name = "step2.profile_mm", .key = "step2.profile", .measure = "step2.profile_mm", .stage = kStep2,
                .possible = ranges.on_the_table, .worst_miss = ranges.mould_mm, .from_outline = true},
    ReadingKind{.name = "step2.plateau_sag_mm", .key = "step2.plateau_sag_mm", .measure = "step2.plateau_sag_mm",
                .stage = kStep2, .possible = ranges.sag, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step2.height_mm", sags_within}, {"step1.height_mm", sags_within}}}, .advised = true,
                .checked = true},
    ReadingKind{.name = "step2.plateau_width_mm", .key = "step2.plateau_width_mm", .measure = "step2.plateau_width_mm",
                .stage = kStep2, .possible = ranges.on_the_table, .worst_miss = ranges.mould_mm, .advised = true,
                .checked = true}};
}

std::vector<ReadingKind> after_drops_kinds(const SlumpRanges& ranges) {
  return {
    ReadingKind{.name = "after_drops.spilled_share", .key = "", .measure = "", .stage = kAfterDrops,
                .possible = ranges.share},
    ReadingKind{.name = "after_drops.height_mm", .key = "after_drops.height_mm", .measure = "after_drops.height_mm",
                .stage = kAfterDrops, .possible = ranges.height, .worst_miss = ranges.mould_mm,
                .ceilings = {{{"step2.height_mm", not_raised}, {"step1.height_mm", not_raised}}}, .advised = true,
                .checked = true, .repeatability = published, .published_deviation = ranges.deviation_of_height},
    ReadingKind{.name = "after_drops.spread_mm", .key = "after_drops.spread_mm", .measure = "after_drops.spread_mm",
                .stage = kAfterDrops, .possible = ranges.spread, .bounded_by = the_table, .worst_miss = ranges.mould_mm, .advised = true,
                .checked = true, .repeatability = published_spread,
                .published_deviation = ranges.deviation_of_spread}};
}

ReadingKind tilt_kind() {
  return {.name = "tilt.slide_angle_deg", .key = "tilt.slide_angle_deg", .measure = "tilt.slide_angle_deg",
          .stage = kTilt, .possible = {0, kSteepest}, .worst_miss = kSteepest, .on_request = true};
}
// clang-format on

}  // namespace

bool is_asked_for(const SlumpTest& test, std::string_view reading) {
  if (reading == "step1.angle_of_repose_deg") return test.reading.flank.has_value();
  if (reading == "tilt.slide_angle_deg") return test.tilt.has_value();
  return (reading == "step1.t500_s" || reading == "step1.flow_time_s") && test.reading.flow.has_value();
}

std::vector<ReadingKind> reading_kinds(const SlumpTest& test) {
  const SlumpRanges ranges(test);
  std::vector<ReadingKind> kinds = fill_kinds(ranges);
  for (ReadingKind& kind : step1_kinds(ranges)) {
    if (kind.on_request) kind.advised = kind.checked = is_asked_for(test, kind.name);
    kinds.push_back(kind);
  }
  for (ReadingKind& kind : step2_kinds(ranges)) {
    const bool has_sides = test.drop && test.drop->motion == TableMotion::hinged;
    if (kind.name == "step2.plateau_sag_mm" && !has_sides) kind.lack = no_sides;
    if (!test.drop) kind.lack = no_plate;
    kinds.push_back(kind);
  }
  for (ReadingKind& kind : after_drops_kinds(ranges)) {
    if (!test.drop || test.drop->drops == 1) kind.lack = test.drop ? one_drop : no_plate;
    kinds.push_back(kind);
  }
  kinds.push_back(tilt_kind());
  kinds.back().advised = kinds.back().checked = is_asked_for(test, kinds.back().name);
  return kinds;
}

std::vector<std::string> reading_names(const SlumpTest& test) {
  std::vector<std::string> names;
  for (const ReadingKind& kind : reading_kinds(test)) {
    const bool curve = kind.name == "step1.spread_curve_mm";
    const auto& outline = curve                  ? test.reading.spread_curve
                          : kind.stage == kStep1 ? test.reading.outline_step1
                                                 : test.reading.outline_step2;
    const bool absent = (kind.from_outline && outline.empty()) || (kind.on_request && !is_asked_for(test, kind.name));
    if (!kind.lack && !absent) names.emplace_back(kind.name);
  }
  return names;
}

}  // namespace pastefit
