#include "calibrate/laboratory/pellet.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {

std::vector<FilePlace> places_in_files(const PelletCrush&) {
  std::vector<FilePlace> places;
  add_places(places, pellet_dimensions);
  add_places(places, surface_dimensions, "tools", "apparatus.tools");
  return places;
}

double moved_time_s(const PelletCrush& test) {
  return (test.fill_height_m - test.pressed_height_m) / (test.punch_speed_m_s * test.press_speedup) +
         test.final_strain * test.pressed_height_m / test.platen_speed_m_s;
}

nlohmann::ordered_json conditions_of(const PelletCrush& test) {
  return {{"pressed_share", test.pressed_height_m / test.fill_height_m},
          {"platen_speed_m_s", test.platen_speed_m_s},
          {"press_speedup", test.press_speedup}};
}

std::string conditions_in_words(const PelletCrush& test) {
  return format(
             "  die                      %g mm across, filled to %g mm, pressed to %g mm at %g mm/s (simulated %g "
             "times "
             "as fast)\n",
             mm * test.die_diameter_m, mm * test.fill_height_m, mm * test.pressed_height_m, mm * test.punch_speed_m_s,
             test.press_speedup) +
         format("  platen                   %g mm/s\n", mm * test.platen_speed_m_s);
}

std::string remarks_on(const PelletCrush& test, std::span<const Readings> runs) {
  constexpr double close = 0.95;
  const auto rising = std::ranges::count_if(runs, [&](const Readings& run) {
    return run.find("pellet.strain_at_peak").value_or(0) > close * test.final_strain;
  });
  if (rising == 0) return {};
  return format("the stress of %d of %zu pellets still rose at the final strain of %g: their strength is not a peak",
                static_cast<int>(rising), runs.size(), test.final_strain);
}

std::vector<Drawing> drawings_of(const PelletCrush& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  Drawing drawing = drawing_of_curves("Crushing of the pellet", "strain", "stress [Pa]", runs);
  if (const auto* strength = find_measurement(measured, "pellet.dynamic_yield_strength_pa")) {
    drawing.lines.push_back({"laboratory, strength",
                             DrawnBy::laboratory,
                             {{0, strength->value}, {test.final_strain, strength->value}},
                             strength->standard_deviation});
    if (const auto* peak = find_measurement(measured, "pellet.strain_at_peak"))
      drawing.lines.push_back({"laboratory, strain at the peak",
                               DrawnBy::laboratory,
                               {{peak->value, 0}, {peak->value, strength->value}},
                               0});
  }
  return {drawing};
}

}  // namespace pastefit
