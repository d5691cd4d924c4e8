#pragma once

#include <array>
#include <vector>

#include "core/apparatus/dimension.h"
#include "core/apparatus/reading_kind.h"
#include "core/apparatus/specimen.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// Ribs of a plate, across the direction of shear. As many as come nearest to the pitch stand evenly over the length of
/// the cell, which is without end.
struct RibSizes {
  double height_m = 0, thickness_m = 0, pitch_m = 0;
};

/// The shear cell as one value: granules between two ribbed plates and two smooth sides, in a slice that repeats along
/// the direction of shear. The lid is pressed on with a constant force and free to rise; the base moves at constant
/// speed; what drags the lid along, over its area, is the shear stress.
///
/// The density of a granule is `bulk_density_kg_m3`. The lid is as wide as the cell.
///
/// Shearing is slow in a laboratory. The simulation shears `shear_speedup` times as fast; up to where that moves no
/// reading, it is the same test (README.md of this folder).
/// Source: Karkala et al., Processes 7 (2019) 278.
struct ShearCell : Specimen {
  double length_m = 0.018;       ///< along x, in which everything repeats
  double width_m = 0.023;        ///< between the sides
  double fill_height_m = 0.016;  ///< above the base plate, to which the cell is filled and struck off
  double pour_speed_m_s = 1;     ///< at which granules arrive in the cell; they sink no faster
  RibSizes lid_ribs{0.003, 0.0008, 0.0105};
  RibSizes base_ribs{0.002, 0.001, 0.00535};
  double normal_stress_pa = 2000;     ///< of the lid, weight and force together
  double lid_speed_m_s = 0.1;         ///< at which the lid sinks where nothing resists
  double shear_speed_m_s = 3.813e-5;  ///< of the base: the laboratory's
  double shear_speedup = 500;
  double final_displacement_m = 0.0114;  ///< of the base

  WallContact tools{2.11e11, 0.33, 0.2, 0.0, 0.0, 0.0};  ///< plates, ribs and sides: polished steel
};

inline constexpr std::array<Dimension<RibSizes>, 3> rib_dimensions{{
    {"height_m", &RibSizes::height_m, 0, 1, "from the plate to the crest; 0: none"},
    {"thickness_m", &RibSizes::thickness_m, 1e-6, 1, "along the motion"},
    {"pitch_m", &RibSizes::pitch_m, 1e-6, 1, "from one rib to the next"},
}};
inline constexpr std::array<Dimension<ShearCell>, 9> shear_dimensions{{
    {"length_m", &ShearCell::length_m, 1e-4, 1,
     "of the piece that is simulated, along the motion; it repeats without end"},
    {"width_m", &ShearCell::width_m, 1e-4, 1, "between the sides"},
    {"fill_height_m", &ShearCell::fill_height_m, 1e-4, 1, "above the base plate, at which the granules are struck off"},
    {"pour_speed_m_s", &ShearCell::pour_speed_m_s, 1e-3, 10, "at which granules arrive in the cell", true},
    {"normal_stress_pa", &ShearCell::normal_stress_pa, 1, 1e7, "of the lid, its weight and what presses on it"},
    {"lid_speed_m_s", &ShearCell::lid_speed_m_s, 1e-4, 10, "at which the lid sinks where nothing resists", true},
    {"shear_speed_m_s", &ShearCell::shear_speed_m_s, 1e-8, 1, "of the base"},
    {"shear_speedup", &ShearCell::shear_speedup, 1, 1e6, "the simulation shears so many times as fast", true},
    {"final_displacement_m", &ShearCell::final_displacement_m, 1e-5, 1, "of the base"},
}};

/// Every fault that keeps this test from being simulated; places are paths of fields, e.g. "lid_ribs.height_m".
Faults validate(const ShearCell& test);

/// Runs the test. Same test, options and program: same bits. Requirement: `validate(test)` is empty.
/// Limits: a cell that stays half empty is a failure; a stress that still changed at the end is marked as not settled.
Outcome simulate(const ShearCell& test, const RunOptions& options = {});

/// Every reading of the test, in the order in which a simulation gives them.
std::vector<ReadingKind> reading_kinds(const ShearCell& test);

/// Number of granules that are poured.
double poured_grains(const ShearCell& test);

/// Area of the lid [m^2], and volume between the base plate and the fill height, ribs included [m^3].
double area_m2(const ShearCell& test);
double filled_volume_m3(const ShearCell& test);

/// Distance of ribs that stand evenly, as near to their pitch as the length allows [m].
double even_pitch_m(const RibSizes& ribs, double length_m);

/// How quickly the bed is sheared against how quickly a granule is pushed into a gap, v/H d sqrt(rho/p); below 1e-3 the
/// speed is known to move no stress (GDR MiDi 2004, Eur. Phys. J. E 14:341).
double inertial_number(const ShearCell& test);

}  // namespace pastefit
