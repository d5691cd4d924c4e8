#pragma once

#include <span>

#include "calibrate/laboratory/measurement.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

/// Width of the cone of this height that holds what the mould holds: 2 sqrt(3 V/(pi h)). Requirement: height > 0.
double cone_width_mm(const SlumpTest& test, double height_mm);

/// Whether the table is that of ASTM C230, which drops by half an inch: its flow is the increase of the width over the
/// mould's base, in per cent (ASTM C1437).
bool gives_flow_in_percent(const SlumpTest& test);

/// Width [mm] of a flow in per cent.
inline double width_of_flow_mm(const SlumpTest& test, double percent) {
  return 2e3 * test.mould.base_radius_m * (1 + percent / 100);
}

/// Judges each height against the width of the same heap by its share of the cone's width, the width over that of the
/// cone:
///     a pancake 1/sqrt(3) = 0.58, a paraboloid sqrt(2/3) = 0.82, a cone 1.
/// No convex heap is wider than the cone, but one with a skirt is: above 1 is a note. No heap fits into less than the
/// pancake: below its 0.58 the note says what may have been taken for what, 3 deviations below it is a fault. The
/// deviation of its share of the cone's width is that of the laboratory's means, carried through its share of the
/// cone's width ~ D sqrt(h): its share of the cone's width sqrt((s_D/D)^2 + (s_h/2h)^2). A slump of a few millimetres
/// is noted, too: it may be in another unit; so are a width that may be a flow in per cent, and readings after the
/// first of several drops without those after all of them. A time to a width that the heap does not reach, by more
/// than the deviation of its width, is a fault. Limits: the heap has the volume of the mould, nothing has flowed off
/// the table, and its height is that of its highest point, or near it.
ReadingCheck check_readings(const SlumpTest& test, std::span<const Measurement> measurements);

}  // namespace pastefit
