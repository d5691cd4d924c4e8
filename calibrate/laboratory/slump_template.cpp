#include "calibrate/laboratory/slump.h"

namespace pastefit {
namespace {

constexpr std::string_view slump_lab =
    R"(// What a laboratory measured in a slump test. Lines like this one are comments; the unit is in each key.
{
  "format": "pastefit-lab-1",
  "title": "my paste, batch 1",

  %provenance%

  // Presets: abrams, abrams-en, hinged-plate (drops once), haegermann-table and astm-c1437 (dropped 15 and 25 times),
  // haegermann (no strokes), mini-cone, lifted-cylinder. One of them with what belongs to it: pastefit template lab --mould NAME.
  // Give only what differs from the preset; without a preset give everything but the drop plate. With another mould
  // change the speed, the grains and the deviations below, too, and the study's tolerances: these are a tall cone's.
  "apparatus": {
    "preset": "abrams",
    // "mould": {"base_diameter_mm": 200, "top_diameter_mm": 100, "height_mm": 300},
    // "table_length_mm": 900,
    // "drop_plate": {"length_mm": 700, "mass_kg": 16, "lift_height_mm": 40, "lift_duration_s": 0.5, "drops": 1},
    // A table that falls upright: "motion": "vertical"; several drops: "drops": 15, "period_s": 1 from one to the next.
    // "reading": {"height": "axis", "probe_diameter_mm": 40},  // or "highest": the highest point of the heap
    "lift_velocity_mm_s": 100
  },

  // Of the fresh material, as it fills the mould.
  "material": {"bulk_density_kg_m3": 2300},
  // Beside the density what a vane read, to be compared: "yield_stress_pa": {"value": 500, "standard_deviation": 50}.

  // What it was mixed of, in any names with their units: not simulated, but in the table of many studies (pastefit batch).
  // "mix": {"water_kg_m3": 180, "superplasticizer_kg_m3": 4.5},

  // Spheres of the simulation: larger than real grains, a tenth of the mould's smallest opening or less.
  // Equal spheres, {"distribution": "mono", "radius_mm": 8}, lie in layers and shear off along them; they cost a fifth less.
  // Or {"distribution": "normal", "radius_mm": 8, "standard_deviation_mm": 1, "smallest_mm": 6, "largest_mm": 10}.
  "grains": {"distribution": "uniform", "smallest_mm": 6, "largest_mm": 10},

  // Readings are of heaps that stood. If some sheared off, say how many of all that were made:
  // "repeats": {"made": 4, "sheared": 1},

  // Either value and standard deviation of one reading, or all repeats.
  // Step 1, mould lifted: step1.height_mm or step1.slump_mm, step1.height_max_mm, step1.spread_mm. Forms of these by
  // other standards: step1.height_axis_mm, step1.spread_orthogonal_mm. Shift of the top's middle: step1.lateral_shift_mm.
  // Step 2, plate dropped: the same with step2 but the shift, and step2.plateau_sag_mm, step2.plateau_width_mm.
  // After all drops, if there are several: after_drops.spread_mm, after_drops.height_mm.
  // How it flows, from the beginning of the lift: step1.t500_s, the time to "reading": {"flow": {"diameter_mm": 500}},
  // step1.flow_time_s until it stops, "step1.spread_curve": {"points": [[0.5, 300], [1, 420], [3, 510]], "standard_deviation": 10}.
  // Of a dry material: step1.angle_of_repose_deg (pastefit template lab --mould lifted-cylinder).
  // The filling: fill.mass_kg. The outline off a photograph from the side, x from the middle of the table:
  // "step1.profile": {"points": [[-150, 4], [-80, 40], [0, 68], [90, 35], [150, 4]], "standard_deviation": 6}
  "measurements": {
    "step1.slump_mm": {"repeats": [158, 165, 163], "standard_deviation": 7.5},  // beside repeats: the least deviation
    "step1.spread_mm": {"value": 310, "standard_deviation": 25}
  }
}
)";

constexpr std::string_view slump_study =
    R"(// Which contact parameters are fitted to which measurements, and how. Lines like this one are comments.
{
  "format": "pastefit-study-1",
  "title": "calibration of my paste",
  "lab": "lab.json",  // path as seen from this file
  // Several tests of one material, in place of "lab" and "weights"; one that is held out is predicted, not fitted:
  // "tests": [{"name": "slow", "lab": "slow.json", "weights": {"step1.spread_mm": 0}},
  //           {"name": "fast", "lab": "fast.json", "hold_out": true}],

  // normal: hertz, or jkr (grains that stick where they touch). attraction across a gap: polynomial, linear, exponential,
  // capillary or none. A parameter that the chosen laws do not use is an error.
  // film: a liquid bridge forms when the liquid shells touch; touch: when the grains do (there is no formation_ratio).
  // rolling_model: spring_dashpot, constant_torque or none.
  // friction_basis: elastic (cohesion strengthens friction) total or net (of the whole normal force).
  "contact": {"normal": "hertz", "attraction": "polynomial", "formation": "film", "rolling_model": "spring_dashpot", "friction_basis": "total"},

  // Free: [lower, upper] bounds, and a scale (linear or log) if it is not the default. Fixed: a value.
  // Known, but not for sure: {"free": [0.1, 0.5], "prior": {"value": 0.3, "standard_deviation": 0.05}}.
  // Parameters that are not named have their default value. R is the mean grain radius.
  "parameters": {
    "strength_pa": {"free": [10, 40000], "scale": "log"},  // attraction at touch over R^2
    // The shape of a tough bridge, of which heaps stand. Two readings do not tell the shape: free it, {"free": [0, 0.5]},
    // {"free": [-0.5, 1]} and {"free": [0, 1]}, for narrow heaps that this one does not reach.
    "rupture_force_ratio": {"value": 0.5},       // share of it left when the bridge ruptures
    "curvature": {"value": -0.5},                // decay: -1 flat at touch, 0 straight, 1 flat at rupture
    "rupture_gap_ratio": {"free": [0.4, 1], "scale": "log"},  // gap at rupture over R; small ones scatter, or shear off
    "formation_ratio": {"value": 0.3},           // gap at which a bridge forms over the one at which it ruptures
    "friction": {"free": [0.05, 0.3], "scale": "log"},  // between grains; heaps with more shear off. Spread not fitted: {"value": 0.15}
    "rolling_friction": {"free": [0, 0.5]}       // the same: {"value": 0.02}
    // "table_rolling_friction": {"value": 0.1}  // decides the heap where grains are dry or weak
    // "adhesion_pa": {"free": [100, 10000]}  // of jkr: surface energy over R
  },

  // Every measurement has the weight 1; 0: reported, not fitted. A slump counts as a height.
  // "weights": {"step1.spread_mm": 0},
  // How far off a reading may be is the laboratory's standard deviation, but half a grain's radius at least. Others:
  // "tolerances": {"step1.height_mm": 7.5, "step1.spread_mm": 25},

  "search": {
    "strategy": "default",
    "screening": 8,              // candidates spread over the bounds at the start; of the strength where the slump says
    "budget_simulations": 150,   // in all, confirmation included
    "packings": 2,               // random packings of a candidate with coarse grains
    "max_pending": 0,            // candidates under way when the next is proposed; 1 saves time and costs simulations
    "confirmation_packings": 8,  // fresh packings for the best candidate
    // Of its heaps that shear off (the top shifts by more than 0.4 of the mould's wider radius): the standards repeat the test.
    "rejected_share": 0.2,       // at most; 1: not judged
    "examination_simulations": 12,  // afterwards, of the same budget: which other materials fit as well
    // "tolerance_mm": 5,        // for every length without a tolerance of its own
    "coarse_first": false,       // true: look with grains 1.5 times as large first; fewer simulations, confirmed as ever
    "end_early": true,           // candidates that are far off end early; false: every simulation runs to its end
    "seed": 1
  }
}
)";

}  // namespace

Templates templates_of(const SlumpTest&) {
  return {slump_lab, slump_study};
}

}  // namespace pastefit
