#pragma once

#include <span>

#include "calibrate/laboratory/measurement.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

/// Width of a cone of this height with the volume of the mould: 2 sqrt(3 V/(pi h)). Requirement: height > 0.
double cone_width_mm(const SlumpTest& test, double height_mm);

/// True for the table of ASTM C230, which drops by half an inch. Its flow is the increase of the width over the mould's
/// base, in per cent (ASTM C1437).
bool gives_flow_in_percent(const SlumpTest& test);

/// Width [mm] for a flow in per cent.
inline double width_of_flow_mm(const SlumpTest& test, double percent) {
  return 2e3 * test.mould.base_radius_m * (1 + percent / 100);
}

/// Checks heights against widths of the same heap by the share s, the measured width over that of the cone of the same
/// height and volume:
///     pancake 1/sqrt(3) = 0.58, paraboloid sqrt(2/3) = 0.82, cone 1.
/// No convex heap is wider than the cone, but one with a skirt is: s > 1 by more than the deviations is a doubt. No
/// heap is narrower than the pancake: s < 0.58 is a doubt with likely mistakes, and 3 deviations below it a fault. With
/// s ~ D sqrt(h), the deviations of the means give the deviation s sqrt((s_D/D)^2 + (s_h/2h)^2). Other heaps are a
/// note. Further doubts: a slump of a few millimetres, or a width that may be a flow in per cent, because of a possible
/// wrong unit; readings after the first of several drops without those after all of them. Further fault: a time to a
/// width that the heap does not reach, by more than the deviation of its width. Limits: the heap has the volume of the
/// mould, nothing has flowed off the table, and its height is at or near its highest point.
ReadingCheck check_readings(const SlumpTest& test, std::span<const Measurement> measurements);

}  // namespace pastefit
