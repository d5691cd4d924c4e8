#pragma once

#include <array>
#include <vector>

#include "core/apparatus/dimension.h"
#include "core/apparatus/reading_kind.h"
#include "core/apparatus/specimen.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// The pellet crush test: cohesive granules are poured into a die and pressed by a punch; punch and die are removed,
/// and a platen crushes the pellet at constant speed. The dynamic yield strength is the largest force on the platen
/// over the area of the die, up to the final strain.
///
/// `bulk_density_kg_m3` is the density of a granule: how densely they fill the die follows from pouring, and is a
/// reading. The punch is as wide as the die (its clearance is smaller than a granule) and the platen wider than the
/// pellet.
///
/// Laboratories press slowly. The simulation presses `press_speedup` times as fast and waits for rest before it
/// withdraws the punch; this is equivalent as long as no reading changes with it (README.md of this folder).
/// Source: Karkala et al., Processes 7 (2019) 278.
struct PelletCrush : Specimen {
  double die_diameter_m = 0.025;
  double fill_height_m = 0.029;     ///< of the die, at which it is struck off
  double pour_speed_m_s = 1;        ///< at which granules arrive in the die; also the limit of their sinking speed
  double pressed_height_m = 0.022;  ///< of the bed at the end of pressing
  double punch_speed_m_s = 0.0015;  ///< in the laboratory
  double press_speedup = 50;
  double platen_speed_m_s = 0.1;
  double final_strain = 0.2;  ///< at which the platen stops

  WallContact tools{2.11e11, 0.33, 0.2, 0.0, 0.0, 0.0};  ///< die, punch, platen and floor: polished steel
};

inline constexpr std::array<Dimension<PelletCrush>, 8> pellet_dimensions{{
    {"die_diameter_m", &PelletCrush::die_diameter_m, 1e-4, 1, "inner diameter of the die"},
    {"fill_height_m", &PelletCrush::fill_height_m, 1e-4, 1,
     "height at which the poured granules are struck off; in a shear cell, measured from the base plate"},
    {"pour_speed_m_s", &PelletCrush::pour_speed_m_s, 1e-3, 10,
     "speed at which poured granules arrive in the die or cell", true},
    {"pressed_height_m", &PelletCrush::pressed_height_m, 1e-4, 1, "height of the bed at the end of pressing"},
    {"punch_speed_m_s", &PelletCrush::punch_speed_m_s, 1e-7, 10, "speed of the punch in the laboratory"},
    {"press_speedup", &PelletCrush::press_speedup, 1, 1e6,
     "speed of the simulated punch, divided by its speed in the laboratory", true},
    {"platen_speed_m_s", &PelletCrush::platen_speed_m_s, 1e-4, 10, "speed of the platen that crushes the pellet"},
    {"final_strain", &PelletCrush::final_strain, 0.01, 0.8, "strain of the pellet at which the platen stops", true},
}};

/// Returns the reasons why the test cannot run; empty if it can. Places are field paths, e.g. "die_diameter_m".
Faults validate(const PelletCrush& test);

/// Runs the test. Same test, options and program: same bits. Requirement: `validate(test)` is empty.
/// Errors: a pellet that collapses without its die and a die that stays half empty are failures.
Outcome simulate(const PelletCrush& test, const RunOptions& options = {});

/// All readings of the test, in the order of the simulation.
std::vector<ReadingKind> reading_kinds(const PelletCrush& test);

/// Number of granules poured.
double grains_needed(const PelletCrush& test);

/// Inner volume of the die up to the fill height [m^3], and area of the pellet [m^2].
double filled_volume_m3(const PelletCrush& test);
double area_m2(const PelletCrush& test);

}  // namespace pastefit
