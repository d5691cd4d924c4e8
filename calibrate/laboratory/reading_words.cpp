#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "calibrate/laboratory/measurement.h"

namespace pastefit {

std::string_view meaning_of_reading(std::string_view key) {
  using Meaning = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Meaning, 30> meanings{{
      {"fill.mass_kg", "mass of the mould's content"},
      {"step1.height_mm", "height of the heap at the point that apparatus.reading.height names"},
      {"step1.slump_mm", "height of the mould minus height of the heap; an alternative to height_mm"},
      {"step1.height_max_mm", "height of the highest point of the heap"},
      {"step1.height_axis_mm", "height at the displaced centre of the struck-off top"},
      {"step1.lateral_shift_mm", "sideways shift of the centre of the top"},
      {"step1.spread_mm", "width of the heap, mean over all directions"},
      {"step1.spread_orthogonal_mm", "mean of two widths of the heap at right angles"},
      {"step1.profile",
       "outline of the heap in side view; its residual is the root mean square difference between measured and "
       "simulated outline"},
      {"step1.t500_s", "time from the beginning of the lift until the spread is apparatus.reading.flow.diameter_mm"},
      {"step1.flow_time_s", "time from the beginning of the lift until the spread is 99 % of its final value"},
      {"step1.spread_curve",
       "spread as a function of the time from the beginning of the lift; its residual is the root mean square "
       "difference between measured and simulated curve"},
      {"step1.angle_of_repose_deg",
       "slope of the part of the flank that apparatus.reading.flank gives, mean over all directions"},
      {"step2.plateau_sag_mm",
       "height difference of the top over apparatus.reading.sag_window_mm, positive if the top is lower towards the "
       "plate's free edge"},
      {"step2.plateau_width_mm", "length over which the heap has at least 0.8 of its height at the axis"},
      {"after_drops.height_mm", "height of the heap after all drops, at the point that apparatus.reading.height names"},
      {"after_drops.spread_mm", "width of the heap after all drops, mean over all directions"},
      {"tilt.slide_angle_deg", "inclination of the table at which the heap has slid by apparatus.tilt.slide_mm"},
      {"level.rebound_height_mm", "rebound height of the ball from the level plate"},
      {"tilted.rebound_height_mm", "rebound height of the ball from the tilted plate"},
      {"tilted.spin_rad_s", "spin of the ball after its rebound from the tilted plate"},
      {"die.mass_g", "mass of the granules in the die"},
      {"pellet.height_mm", "height of the pellet before it is crushed"},
      {"pellet.dynamic_yield_strength_pa",
       "largest stress on the platen: force divided by the cross-sectional area of the die"},
      {"pellet.strain_at_peak", "strain of the pellet at the largest stress on the platen"},
      {"bed.mass_g", "mass of the granules in the simulated slice of the cell"},
      {"bed.height_mm", "height of the bed under the loaded lid, before the base moves"},
      {"shear.stress_pa", "shear stress on the lid, mean over the steady part"},
      {"shear.peak_stress_pa", "largest shear stress on the lid"},
      {"shear.height_mm", "height of the bed, mean over the steady part"},
  }};
  const auto found = std::ranges::find(meanings, key, &Meaning::first);
  if (found != meanings.end()) return found->second;
  // After the drop, most readings are those after the lift.
  return key.starts_with("step2.") ? meaning_of_reading("step1." + std::string(key.substr(6))) : std::string_view();
}

}  // namespace pastefit
