#include "calibrate/laboratory/granule_tests.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {

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

nlohmann::ordered_json conditions_of(const ShearCell& test) {
  return {{"normal_stress_pa", test.normal_stress_pa},
          {"inertial_number", inertial_number(test)},
          {"shear_speedup", test.shear_speedup}};
}

std::string conditions_in_words(const ShearCell& test) {
  return format("  cell                     %g mm of it, %g mm wide, filled to %g mm, under %g Pa\n",
                mm * test.length_m, mm * test.width_m, mm * test.fill_height_m, test.normal_stress_pa) +
         format("  base                     %g mm at %g mm/s (simulated %g times as fast)\n",
                mm * test.final_displacement_m, mm * test.shear_speed_m_s, test.shear_speedup);
}

std::string remarks_on(const ShearCell& test, std::span<const Readings> runs) {
  const double half_way = 0.5 * mm * test.final_displacement_m;
  const auto changing = std::ranges::count_if(
      runs, [&](const Readings& run) { return run.find("shear.steady_from_mm").value_or(0) > half_way; });
  if (changing == 0) return {};
  return format("the stress of %d of %zu beds still changed beyond half of the displacement of %g mm: it is not steady",
                static_cast<int>(changing), runs.size(), mm * test.final_displacement_m);
}

std::vector<Drawing> drawings_of(const ShearCell& test, std::span<const SeenRun> runs,
                                 std::span<const Measurement> measured) {
  Drawing drawing = drawing_of_curves("Shearing of the bed", "displacement of the base [mm]", "stress [Pa]", runs);
  const double end_mm = mm * test.final_displacement_m;
  for (const auto& [reading, name] : {std::pair("shear.stress_pa", "laboratory, steady stress"),
                                      std::pair("shear.peak_stress_pa", "laboratory, peak stress")})
    if (const auto* one = find_measurement(measured, reading))
      drawing.lines.push_back(
          {name, DrawnBy::laboratory, {{0, one->value}, {end_mm, one->value}}, one->standard_deviation});
  return {drawing};
}

}  // namespace pastefit
