#include "core/rigs/slump/slump_readings.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/rigs/slump/slump_test.h"

namespace pastefit {

namespace {

constexpr double kRoom = 0.02;  // for the tolerances of an apparatus

double mould_mm(const SlumpTable& test) {
  return 1e3 * test.mould.height_m;
}

ReadingRange height(const SlumpTable& test) {
  return {0, (1 + kRoom) * mould_mm(test)};
}

ReadingRange slump(const SlumpTable& test) {
  return {-kRoom * mould_mm(test), mould_mm(test)};
}

ReadingRange spread(const SlumpTable& test) {
  const double base_mm = 2e3 * test.mould.base_radius_m;
  return {(1 - kRoom) * base_mm, std::max(1e3 * test.table_length_m, base_mm)};
}

ReadingRange on_the_table(const SlumpTable& test) {
  return {0, 1e3 * test.table_length_m};
}

ReadingRange sag(const SlumpTable& test) {
  return {-mould_mm(test), mould_mm(test)};
}

ReadingRange mass(const SlumpTable& test) {
  const double filling_kg = test.bulk_density_kg_m3 * volume_m3(test.mould);
  return {0.5 * filling_kg, 1.5 * filling_kg};
}

ReadingRange share(const SlumpTable&) {
  return {0, 1};
}

constexpr std::string_view kHighest = "the highest point of a heap is not below its height";
constexpr std::string_view kNotRaised = "a drop does not raise a heap";
constexpr std::string_view kNotDrawn = "a drop does not draw a heap together";
constexpr std::string_view kPublished =
    "published for the slump: 21 mm as the 95 % limit between two results (ASTM C143-98), so about 7.5";

constexpr Stage fill = Stage::fill, step1 = Stage::step1, step2 = Stage::step2;

// clang-format off
constexpr std::array kKinds{
    ReadingKind{.name = "fill.mass_kg", .key = "fill.mass_kg", .measure = "fill.mass_kg", .stage = fill,
                .possible = mass, .worst_miss = nullptr, .advised = true, .checked = true},
    ReadingKind{.name = "fill.solid_fraction", .key = "", .measure = "", .stage = fill,
                .possible = share, .worst_miss = nullptr, .checked = true},
    ReadingKind{.name = "step1.spilled_share", .key = "", .measure = "", .stage = step1,
                .possible = share, .worst_miss = nullptr},
    ReadingKind{.name = "step1.height_mm", .key = "step1.height_mm", .measure = "step1.height_mm", .stage = step1,
                .possible = height, .worst_miss = mould_mm, .ceilings = {{{"step1.height_max_mm", kHighest}}},
                .advised = true, .ends_early = true, .repeatability = kPublished},
    ReadingKind{.name = "step1.slump_mm", .key = "step1.slump_mm", .measure = "step1.height_mm", .stage = step1,
                .possible = slump, .worst_miss = mould_mm, .repeatability = kPublished},
    ReadingKind{.name = "step1.height_axis_mm", .key = "step1.height_axis_mm", .measure = "step1.height_axis_mm",
                .stage = step1, .possible = height, .worst_miss = mould_mm,
                .ceilings = {{{"step1.height_max_mm", kHighest}}}, .checked = true, .repeatability = kPublished},
    ReadingKind{.name = "step1.height_max_mm", .key = "step1.height_max_mm", .measure = "step1.height_max_mm",
                .stage = step1, .possible = height, .worst_miss = mould_mm, .advised = true, .checked = true,
                .repeatability = kPublished},
    ReadingKind{.name = "step1.lateral_shift_mm", .key = "step1.lateral_shift_mm", .measure = "step1.lateral_shift_mm",
                .stage = step1, .possible = on_the_table, .worst_miss = mould_mm},
    ReadingKind{.name = "step1.spread_mm", .key = "step1.spread_mm", .measure = "step1.spread_mm", .stage = step1,
                .possible = spread, .worst_miss = mould_mm, .ceilings = {{{"step2.spread_mm", kNotDrawn}}},
                .advised = true, .checked = true},
    ReadingKind{.name = "step1.spread_orthogonal_mm", .key = "step1.spread_orthogonal_mm",
                .measure = "step1.spread_orthogonal_mm", .stage = step1, .possible = spread, .worst_miss = mould_mm},
    ReadingKind{.name = "step1.profile_mm", .key = "step1.profile", .measure = "step1.profile_mm", .stage = step1,
                .possible = on_the_table, .worst_miss = mould_mm, .with_outline = true},
    ReadingKind{.name = "step2.spilled_share", .key = "", .measure = "", .stage = step2,
                .possible = share, .worst_miss = nullptr},
    ReadingKind{.name = "step2.height_mm", .key = "step2.height_mm", .measure = "step2.height_mm", .stage = step2,
                .possible = height, .worst_miss = mould_mm,
                .ceilings = {{{"step2.height_max_mm", kHighest}, {"step1.height_mm", kNotRaised}}},
                .advised = true, .repeatability = kPublished},
    ReadingKind{.name = "step2.slump_mm", .key = "step2.slump_mm", .measure = "step2.height_mm", .stage = step2,
                .possible = slump, .worst_miss = mould_mm, .repeatability = kPublished},
    ReadingKind{.name = "step2.height_axis_mm", .key = "step2.height_axis_mm", .measure = "step2.height_axis_mm",
                .stage = step2, .possible = height, .worst_miss = mould_mm,
                .ceilings = {{{"step2.height_max_mm", kHighest}}}, .checked = true, .repeatability = kPublished},
    ReadingKind{.name = "step2.height_max_mm", .key = "step2.height_max_mm", .measure = "step2.height_max_mm",
                .stage = step2, .possible = height, .worst_miss = mould_mm,
                .ceilings = {{{"step1.height_max_mm", kNotRaised}}}, .advised = true, .checked = true,
                .repeatability = kPublished},
    ReadingKind{.name = "step2.lateral_shift_mm", .key = "", .measure = "", .stage = step2,
                .possible = on_the_table, .worst_miss = mould_mm},
    ReadingKind{.name = "step2.spread_mm", .key = "step2.spread_mm", .measure = "step2.spread_mm", .stage = step2,
                .possible = spread, .worst_miss = mould_mm, .advised = true, .checked = true},
    ReadingKind{.name = "step2.spread_orthogonal_mm", .key = "step2.spread_orthogonal_mm",
                .measure = "step2.spread_orthogonal_mm", .stage = step2, .possible = spread, .worst_miss = mould_mm},
    ReadingKind{.name = "step2.profile_mm", .key = "step2.profile", .measure = "step2.profile_mm", .stage = step2,
                .possible = on_the_table, .worst_miss = mould_mm, .with_outline = true},
    ReadingKind{.name = "step2.plateau_sag_mm", .key = "step2.plateau_sag_mm", .measure = "step2.plateau_sag_mm",
                .stage = step2, .possible = sag, .worst_miss = mould_mm, .advised = true, .checked = true},
    ReadingKind{.name = "step2.plateau_width_mm", .key = "step2.plateau_width_mm", .measure = "step2.plateau_width_mm",
                .stage = step2, .possible = on_the_table, .worst_miss = mould_mm, .advised = true, .checked = true},
};
// clang-format on

}  // namespace

std::span<const ReadingKind> reading_kinds() {
  return kKinds;
}

const ReadingKind* reading_kind(std::string_view name) {
  const auto found = std::ranges::find(kKinds, name, &ReadingKind::name);
  return found == kKinds.end() ? nullptr : &*found;
}

Stage stage_of(std::string_view name) {
  return name.starts_with("fill.") ? Stage::fill : name.starts_with("step1.") ? Stage::step1 : Stage::step2;
}

std::vector<std::string> observable_names(const SlumpTable& test) {
  std::vector<std::string> names;
  for (const ReadingKind& kind : kKinds) {
    const auto& outline = kind.stage == Stage::step1 ? test.reading.outline_step1 : test.reading.outline_step2;
    const bool has_stage = kind.stage != Stage::step2 || test.drop;
    if (has_stage && !(kind.with_outline && outline.empty())) names.emplace_back(kind.name);
  }
  return names;
}

}  // namespace pastefit
