#pragma once

#include <array>
#include <vector>

#include "core/apparatus/dimension.h"
#include "core/apparatus/reading_kind.h"
#include "core/apparatus/specimen.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// Ribs of a plate, perpendicular to the shear direction: evenly spaced over the periodic length of the cell, at the
/// spacing nearest to the pitch.
struct RibSizes {
  double height_m = 0, thickness_m = 0, pitch_m = 0;
};

/// The shear cell: granules between two ribbed plates and two smooth sides, in a slice that is periodic along the shear
/// direction. A constant force presses the lid, which is free to rise; the base moves at constant speed. The shear
/// stress is the drag on the lid over its area.
///
/// `bulk_density_kg_m3` is the density of a granule. The lid is as wide as the cell.
///
/// Laboratories shear slowly. The simulation shears `shear_speedup` times as fast; this is equivalent as long as no
/// reading changes with it (README.md of this folder).
/// Source: Karkala et al., Processes 7 (2019) 278.
struct ShearCell : Specimen {
  double length_m = 0.018;       ///< along x, the period
  double width_m = 0.023;        ///< between the sides
  double fill_height_m = 0.016;  ///< above the base plate, at which the cell is struck off
  double pour_speed_m_s = 1;     ///< at which granules arrive in the cell; also the limit of their sinking speed
  RibSizes lid_ribs{0.003, 0.0008, 0.0105};
  RibSizes base_ribs{0.002, 0.001, 0.00535};
  double normal_stress_pa = 2000;     ///< of the lid, weight included
  double lid_speed_m_s = 0.1;         ///< sinking speed of the lid without resistance
  double shear_speed_m_s = 3.813e-5;  ///< of the base, in the laboratory
  double shear_speedup = 500;
  double final_displacement_m = 0.0114;  ///< of the base

  WallContact tools{2.11e11, 0.33, 0.2, 0.0, 0.0, 0.0};  ///< plates, ribs and sides: polished steel
};

inline constexpr std::array<Dimension<RibSizes>, 3> rib_dimensions{{
    {"height_m", &RibSizes::height_m, 0, 1, "height of a rib from the plate to its crest; 0: no ribs"},
    {"thickness_m", &RibSizes::thickness_m, 1e-6, 1, "thickness of a rib along the motion"},
    {"pitch_m", &RibSizes::pitch_m, 1e-6, 1, "distance from one rib to the next"},
}};
inline constexpr std::array<Dimension<ShearCell>, 9> shear_dimensions{{
    {"length_m", &ShearCell::length_m, 1e-4, 1,
     "length of the simulated slice along the motion; the slice is periodic"},
    {"width_m", &ShearCell::width_m, 1e-4, 1, "distance between the sides"},
    {"fill_height_m", &ShearCell::fill_height_m, 1e-4, 1,
     "height at which the poured granules are struck off; in a shear cell, measured from the base plate"},
    {"pour_speed_m_s", &ShearCell::pour_speed_m_s, 1e-3, 10, "speed at which poured granules arrive in the die or cell",
     true},
    {"normal_stress_pa", &ShearCell::normal_stress_pa, 1, 1e7,
     "normal stress of the lid, from its weight and its load"},
    {"lid_speed_m_s", &ShearCell::lid_speed_m_s, 1e-4, 10, "sinking speed of the lid without resistance", true},
    {"shear_speed_m_s", &ShearCell::shear_speed_m_s, 1e-8, 1, "speed of the base in the laboratory"},
    {"shear_speedup", &ShearCell::shear_speedup, 1, 1e6,
     "speed of the simulated base, divided by its speed in the laboratory", true},
    {"final_displacement_m", &ShearCell::final_displacement_m, 1e-5, 1,
     "displacement of the base at the end of the test"},
}};

/// Returns the reasons why the test cannot run; empty if it can. Places are field paths, e.g. "lid_ribs.height_m".
Faults validate(const ShearCell& test);

/// Runs the test. Same test, options and program: same bits. Requirement: `validate(test)` is empty.
/// Errors: a cell that stays half empty is a failure; a stress that still changes at the end is marked as not settled.
Outcome simulate(const ShearCell& test, const RunOptions& options = {});

/// All readings of the test, in the order of the simulation.
std::vector<ReadingKind> reading_kinds(const ShearCell& test);

/// Number of granules poured.
double grains_needed(const ShearCell& test);

/// Area of the lid [m^2], and volume between base plate and fill height, ribs included [m^3].
double area_m2(const ShearCell& test);
double filled_volume_m3(const ShearCell& test);

/// Spacing of evenly spaced ribs, as near to their pitch as the length allows [m].
double even_pitch_m(const RibSizes& ribs, double length_m);

/// Inertial number v/H d sqrt(rho/p), the ratio of the time in which a granule is pushed into a gap to the time of
/// shear. Below 1e-3 stress does not depend on speed (GDR MiDi 2004, Eur. Phys. J. E 14:341).
double inertial_number(const ShearCell& test);

}  // namespace pastefit
