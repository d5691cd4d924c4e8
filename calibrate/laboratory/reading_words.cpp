#include <algorithm>
#include <array>
#include <utility>

#include "calibrate/laboratory/measurement.h"

namespace pastefit {

std::string_view meaning_of_reading(std::string_view key) {
  using Meaning = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Meaning, 37> meanings{{
      {"fill.mass_kg", "mass of the mould's content"},
      {"step1.height_mm", "height of the heap, as reading.height states"},
      {"step1.slump_mm", "height of the mould minus that of the heap, instead of height_mm"},
      {"step1.height_max_mm", "of the highest point"},
      {"step1.height_axis_mm", "height at the centre of the struck-off top, wherever it has moved"},
      {"step1.lateral_shift_mm", "sideways shift of the centre of the top"},
      {"step1.spread_mm", "width of the heap, mean over all directions"},
      {"step1.spread_orthogonal_mm", "mean of two widths at right angles"},
      {"step1.profile",
       "the outline as seen from the side; its residual is the root mean square distance between the curves"},
      {"step1.t500_s", "time from the beginning of the lift to the spread reading.flow.diameter_mm"},
      {"step1.flow_time_s", "time from the beginning of the lift until the spread is 99 % of its final value"},
      {"step1.spread_curve",
       "the spread against time, from the beginning of the lift; its residual is the root mean square distance"},
      {"step1.angle_of_repose_deg", "slope of the heap's flank over reading.flank, mean over directions"},
      {"step2.height_mm", "height of the heap, as reading.height states"},
      {"step2.slump_mm", "height of the mould minus that of the heap, instead of height_mm"},
      {"step2.height_max_mm", "of the highest point"},
      {"step2.height_axis_mm", "height at the centre of the struck-off top, wherever it has moved"},
      {"step2.spread_mm", "width of the heap, mean over all directions"},
      {"step2.spread_orthogonal_mm", "mean of two widths at right angles"},
      {"step2.profile",
       "the outline as seen from the side; its residual is the root mean square distance between the curves"},
      {"step2.plateau_sag_mm",
       "height difference of the top over reading.sag_window_mm, positive if the free side is lower"},
      {"step2.plateau_width_mm", "length over which the top has at least 0.8 of the height at the axis"},
      {"after_drops.height_mm", "height of the heap after all drops, as reading.height states"},
      {"after_drops.spread_mm", "width of the heap after all drops, mean over all directions"},
      {"tilt.slide_angle_deg", "inclination of the table at which the heap has slid by tilt.slide_mm"},
      {"level.rebound_height_mm", "of the ball on the level plate"},
      {"tilted.rebound_height_mm", "of the ball on the tilted plate"},
      {"tilted.spin_rad_s", "spin of the ball after the tilted plate"},
      {"die.mass_g", "mass of the granules in the die"},
      {"pellet.height_mm", "before it is crushed"},
      {"pellet.dynamic_yield_strength_pa", "largest stress of the platen, force over the cross section of the die"},
      {"pellet.strain_at_peak", "strain of the pellet at that stress"},
      {"bed.mass_g", "mass of the granules in the simulated piece of the cell"},
      {"bed.height_mm", "height under the lid's load, before the base moves"},
      {"shear.stress_pa", "shear stress of the lid, mean over the steady part"},
      {"shear.peak_stress_pa", "largest stress of the lid"},
      {"shear.height_mm", "of the bed, likewise"},
  }};
  const auto found = std::ranges::find(meanings, key, &Meaning::first);
  return found == meanings.end() ? std::string_view() : found->second;
}

}  // namespace pastefit
