#include "calibrate/laboratory/slump.h"

namespace pastefit {
namespace {

constexpr std::string_view repose_lab =
    R"(// What a laboratory measured of a dry material with a lifted cylinder. Lines like this one are comments; the unit is in
// each key.
{
  "format": "pastefit-lab-1",
  "title": "my grain, batch 1",

  %provenance%

  // There is no standard: give your own cylinder, table and speed. The table has the friction of the laboratory's: glue
  // a layer of the material on it, or fit its friction, too.
  "apparatus": {
    "preset": "lifted-cylinder",
    "mould": {"base_diameter_mm": 80, "top_diameter_mm": 80, "height_mm": 100},
    // "table_length_mm": 500,
    // The angle is that of the flank between these shares of the heap's height: not of the tip and of the foot.
    // "reading": {"flank": {"lower_share": 0.2, "upper_share": 0.8}},
    "lift_velocity_mm_s": 10  // the angle depends on it: measure it
  },

  // As it fills the cylinder, voids included.
  "material": {"bulk_density_kg_m3": 780},

  // Spheres of the simulation, a tenth of the cylinder's diameter or less.
  "grains": {"distribution": "uniform", "smallest_mm": 2.4, "largest_mm": 4},

  // Either value and standard deviation of one reading, or all repeats. One angle does not tell sliding from rolling
  // friction: give the width of the heap, step1.spread_mm, and its height, step1.height_mm, too, if you have them.
  "measurements": {
    "step1.angle_of_repose_deg": {"repeats": [26.1, 28.0, 26.9], "standard_deviation": 1.5}  // the least deviation
  }
}
)";

constexpr std::string_view repose_study =
    R"(// Which contact parameters are fitted to an angle of repose, and how. Lines like this one are comments.
{
  "format": "pastefit-study-1",
  "title": "friction of my grain",
  "lab": "lab.json",  // path as seen from this file

  // Dry grains: nothing attracts them. More laws: `pastefit template study`.
  "contact": {"normal": "hertz", "attraction": "none", "rolling_model": "spring_dashpot", "friction_basis": "elastic"},

  // Free: [lower, upper] bounds. Fixed: a value. Parameters that are not named have their default value.
  // Many pairs of both frictions give the same angle: measure one of them (friction, on an inclined plane) and fix it,
  // or {"free": [0.2, 0.8], "prior": {"value": 0.5, "standard_deviation": 0.05}}.
  "parameters": {
    "friction": {"free": [0.2, 0.8]},          // between grains
    "rolling_friction": {"free": [0.02, 0.5]}, // stands for their shape, too
    "table_friction": {"value": 0.5},
    "table_rolling_friction": {"value": 0.1},
    "mould_friction": {"value": 0.4}
  },

  // How far off a reading may be is the laboratory's standard deviation. Others:
  // "tolerances": {"step1.angle_of_repose_deg": 1},

  "search": {
    "screening": 8,              // candidates spread over the bounds at the start
    "budget_simulations": 60,    // in all, confirmation included
    "packings": 2,               // random packings of a candidate with coarse grains
    "confirmation_packings": 8,  // fresh packings for the best candidate
    "examination_simulations": 10,  // afterwards, of the same budget: which other materials fit as well
    "seed": 1
  }
}
)";

}  // namespace

std::optional<Templates> templates_of_mould(std::string_view preset) {
  if (preset == "lifted-cylinder") return Templates{repose_lab, repose_study};
  return std::nullopt;
}

}  // namespace pastefit
