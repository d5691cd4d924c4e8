#pragma once

#include <array>
#include <vector>

#include "core/apparatus/dimension.h"
#include "core/apparatus/reading_kind.h"
#include "core/apparatus/specimen.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// The pellet crush test as one value: granules that stick are poured into a die, pressed by a punch, and the pellet
/// that is left when punch and die are away is crushed by a platen at constant speed. Its dynamic yield strength is the
/// peak of the force on the platen over the area of the die, up to the final strain.
///
/// The density of a granule is `bulk_density_kg_m3`: how much of the die they fill follows from how they are poured,
/// and is a reading. The punch is as wide as the die (no granule fits into its play) and the platen wider than the
/// pellet.
///
/// Pressing is slow in a laboratory. The simulation presses `press_speedup` times as fast and waits for rest before the
/// punch is withdrawn; up to where that moves no reading, it is the same test (README.md of this folder).
/// Source: Karkala et al., Processes 7 (2019) 278.
struct PelletCrush : Specimen {
  double die_diameter_m = 0.025;
  double fill_height_m = 0.029;     ///< to which the die is filled and struck off
  double pour_speed_m_s = 1;        ///< at which granules arrive in the die; they sink no faster
  double pressed_height_m = 0.022;  ///< of the bed when the punch turns round
  double punch_speed_m_s = 0.0015;  ///< the laboratory's
  double press_speedup = 50;
  double platen_speed_m_s = 0.1;
  double final_strain = 0.2;  ///< at which the platen stops

  WallContact tools{2.11e11, 0.33, 0.2, 0.0, 0.0, 0.0};  ///< die, punch, platen and floor: polished steel
};

inline constexpr std::array<Dimension<PelletCrush>, 8> pellet_dimensions{{
    {"die_diameter_m", &PelletCrush::die_diameter_m, 1e-4, 1, "inner"},
    {"fill_height_m", &PelletCrush::fill_height_m, 1e-4, 1, "at which the granules are struck off"},
    {"pour_speed_m_s", &PelletCrush::pour_speed_m_s, 1e-3, 10, "at which granules arrive in the die", true},
    {"pressed_height_m", &PelletCrush::pressed_height_m, 1e-4, 1, "of the bed when the punch turns round"},
    {"punch_speed_m_s", &PelletCrush::punch_speed_m_s, 1e-7, 10, "of the punch that presses the granules"},
    {"press_speedup", &PelletCrush::press_speedup, 1, 1e6, "the simulation presses so many times as fast", true},
    {"platen_speed_m_s", &PelletCrush::platen_speed_m_s, 1e-4, 10, "of the platen that crushes the pellet"},
    {"final_strain", &PelletCrush::final_strain, 0.01, 0.8, "of the pellet, at which the platen stops", true},
}};

/// Every fault that keeps this test from being simulated; places are paths of fields, e.g. "die_diameter_m".
Faults validate(const PelletCrush& test);

/// Runs the test. Same test, options and program: same bits. Requirement: `validate(test)` is empty.
/// Limits: a pellet that does not stand without its die, a die that stays half empty, are failures.
Outcome simulate(const PelletCrush& test, const RunOptions& options = {});

/// Every reading of the test, in the order in which a simulation gives them.
std::vector<ReadingKind> reading_kinds(const PelletCrush& test);

/// Number of granules that are poured.
double poured_grains(const PelletCrush& test);

/// Inner volume of the die up to the height to which it is filled [m^3], and the area of the pellet [m^2].
double filled_volume_m3(const PelletCrush& test);
double area_m2(const PelletCrush& test);

}  // namespace pastefit
