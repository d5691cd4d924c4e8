#include "calibrate/laboratory/shear.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"

namespace pastefit {

std::vector<FilePlace> places_in_files(const ShearCell&) {
  std::vector<FilePlace> places;
  add_places(places, shear_dimensions);
  add_places(places, rib_dimensions, "lid_ribs", "apparatus.lid_ribs");
  add_places(places, rib_dimensions, "base_ribs", "apparatus.base_ribs");
  add_places(places, surface_dimensions, "tools", "apparatus.tools");
  return places;
}

double moved_time_s(const ShearCell& test) {
  return test.final_displacement_m / (test.shear_speed_m_s * test.shear_speedup);
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
