#pragma once

#include <vector>

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
