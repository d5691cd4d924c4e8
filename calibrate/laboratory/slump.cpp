#include "calibrate/laboratory/slump.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "core/apparatus/slump/ruler.h"
#include "core/world/world.h"

namespace pastefit {
namespace {

constexpr double diameter_mm = 2000;  // millimetres of diameter per metre of radius

double largest_pressure_pa(const SlumpTest& test) {
  return test.bulk_density_kg_m3 * kGravity * test.mould.height_m;
}

/// Spread over time from the beginning of the lift.
void read_spread_curve(ObjectReader& reader, SlumpTest& test) {
  constexpr std::size_t fewest = 3;
  constexpr double longest_s = 600;
  if (reader.pairs("points", test.reading.spread_curve, {0, longest_s}, {0, mm * test.table_length_m}, Need::required,
                   fewest))
    for (auto& [time_s, width] : test.reading.spread_curve) width /= mm;
}

}  // namespace

std::string preparation_key(const SlumpTest& test) {
  const Filling filling = filling_of(test);
  return nlohmann::json{filling.friction, filling.resting_overlap, filling.youngs_modulus_pa}.dump();
}

void read_outline(ObjectReader& reader, const ReadingKind& kind, SlumpTest& test) {
  if (kind.name == "step1.spread_curve_mm") return read_spread_curve(reader, test);
  constexpr std::size_t fewest = 5;
  const double half_table_mm = 0.5 * mm * test.table_length_m;
  const auto kinds = reading_kinds(test);
  const ReadingRange heights = find_kind(kinds, "step1.height_mm")->possible;
  std::vector<OutlinePoint> points;
  if (reader.pairs("points", points, {-half_table_mm, half_table_mm}, {heights.smallest, heights.largest},
                   Need::required, fewest))
    for (auto& [x, z] : points) {
      x *= 1e-3;
      z *= 1e-3;
    }
  (kind.stage == kStep2 ? test.reading.outline_step2 : test.reading.outline_step1) = std::move(points);
}

void ask_for(SlumpTest& test, const ReadingKind& kind) {
  if (kind.name == "step1.angle_of_repose_deg" && !test.reading.flank) test.reading.flank.emplace();
  if (kind.name == "tilt.slide_angle_deg" && !test.tilt) test.tilt.emplace();
  const bool time = kind.name == "step1.t500_s" || kind.name == "step1.flow_time_s";
  if (time && !test.reading.flow) test.reading.flow.emplace();
}

std::vector<FilePlace> places_in_files(const SlumpTest&) {
  std::vector<FilePlace> places{{"mould_wall", "parameters: mould_wall"}, {"table_wall", "parameters: table_wall"}};
  add_places(places, mould_dimensions, "mould", "apparatus.mould");
  add_places(places, slump_dimensions);
  add_places(places, rhythm_dimensions, "drop", "apparatus.drop_plate");
  places.pop_back();  // the last place is that of the plate itself
  add_places(places, plate_dimensions, "drop", "apparatus.drop_plate");
  add_places(places, tilt_dimensions, "tilt", "apparatus.tilt");
  add_places(places, flow_dimensions, "reading.flow", "apparatus.reading.flow");
  add_places(places, flank_dimensions, "reading.flank", "apparatus.reading.flank");
  add_places(places, reading_dimensions, "reading", "apparatus.reading");
  return places;
}

double moved_time_s(const SlumpTest& test) {
  const double lift_s = test.mould.height_m / test.lift_velocity_m_s;
  constexpr double usual_slide_deg = 30;
  if (test.tilt) return lift_s + usual_slide_deg / test.tilt->rate_deg_s;
  if (!test.drop) return lift_s;
  return lift_s + (test.drop->drops - 1) * moving_time_s(*test.drop);
}

std::optional<double> grain_density_of(const SlumpTest& test, const Readings& means) {
  const auto solid = means.find("fill.solid_fraction");
  return solid ? std::optional(test.bulk_density_kg_m3 / *solid) : std::nullopt;
}

std::optional<Outline> heap_at(const SlumpTest& test, const Snapshot& snapshot) {
  const bool stands = snapshot.phase.starts_with("step") || snapshot.phase.find("drops.") != snapshot.phase.npos;
  if (snapshot.drop > 0 || !stands) return std::nullopt;
  return outline(on_table(snapshot.world->particles), test.grains.radius_m);
}

double default_tolerance(const SlumpTest& test, const Measurement& measured) {
  if (measured.reading == "step1.lateral_shift_mm") return mm * kShearedShift * wider_radius_m(test.mould);
  const bool length = measured.reading.ends_with("_mm");
  return length ? std::max(measured.standard_deviation, 0.5 * mm * test.grains.radius_m) : measured.standard_deviation;
}

std::string unseen_by(const SlumpTest&, std::span<const std::string_view> readings,
                      std::span<const std::string_view> parameters) {
  const auto is_width = [](std::string_view name) {
    return name.find("spread") != name.npos || name.find("profile") != name.npos || name.find("plateau") != name.npos;
  };
  if (std::ranges::any_of(readings, is_width)) return {};
  std::string names;
  for (const std::string_view parameter : parameters)
    if (parameter.ends_with("friction")) names += (names.empty() ? "" : ", ") + std::string(parameter);
  if (names.empty()) return {};
  if (std::ranges::any_of(readings, [](std::string_view name) { return name == "step1.angle_of_repose_deg"; }))
    return names.find(',') == names.npos ? ""
                                         : "Free with an angle of repose and no width: " + names +
                                               ".\nMany pairs of sliding and rolling friction give the same angle: fix "
                                               "one of them, or measure the spread.";
  return "Free without a reading of the spread: " + names +
         ".\nThe height alone cannot separate friction from strength: fix the friction, e.g.\n"
         "\"friction\": {\"value\": 0.15}, or measure the spread.";
}

nlohmann::ordered_json conditions_of(const SlumpTest& test) {
  return {{"lift_velocity_m_s", test.lift_velocity_m_s}, {"largest_pressure_pa", largest_pressure_pa(test)}};
}

std::string conditions_in_words(const SlumpTest& test) {
  std::string drops;
  if (test.drop && (test.drop->drops > 1 || test.drop->motion == TableMotion::vertical))
    drops = format("  table                    dropped %d times by %g mm, %s, one drop in %g s\n", test.drop->drops,
                   mm * test.drop->lift_height_m,
                   test.drop->motion == TableMotion::vertical ? "upright" : "about its hinge", test.drop->period_s);
  return format("  mould                    base %g mm, top %g mm, height %g mm, lifted at %g mm/s\n",
                diameter_mm * test.mould.base_radius_m, diameter_mm * test.mould.top_radius_m, mm * test.mould.height_m,
                mm * test.lift_velocity_m_s) +
         drops +
         format("  pressure                 up to %s Pa, the weight of the full mould\n",
                plain(largest_pressure_pa(test)).c_str());
}

std::string remarks_on(const SlumpTest& test, std::span<const Readings> runs) {
  int sheared = 0, whole = 0;
  double all_mm = 0;
  for (const Readings& run : runs) {
    const double height_mm = run.find("step1.height_mm").value_or(0);
    const bool broke = has_sheared(test, run);
    ++(broke ? sheared : whole);
    all_mm += height_mm;
  }
  if (sheared == 0) return {};
  const double limit_mm = mm * kShearedShift * wider_radius_m(test.mould);
  if (runs.size() == 1)
    return format(
        "the heap sheared off: its top shifted by %.0f mm, more than %g mm; standards require such a test to be "
        "repeated",
        *runs[0].find("step1.lateral_shift_mm"), limit_mm);
  const ProbabilityInterval share = binomial_interval(sheared, sheared + whole);
  const std::string heaps = format(
      "%d of %zu heaps sheared off (95 %% interval of the share: %.0f to %.0f %%): the top shifted by more than %g "
      "mm. Standards require such a test to be repeated",
      sheared, runs.size(), 100 * share.lower, 100 * share.upper, limit_mm);
  if (whole == 0) return heaps + ", so the readings are means of sheared heaps";
  return heaps + format(", so the means exclude these heaps. With them, the height after step 1 would be %.1f mm",
                        all_mm / (sheared + whole));
}

}  // namespace pastefit
