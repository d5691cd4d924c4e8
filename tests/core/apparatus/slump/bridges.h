#pragma once

#include "core/laws/materials.h"

namespace pastefit {

/// A bridge whose force falls as a parabola from `touch_n` at touch to zero at the distance `rupture_m`, without a
/// slope there.
inline Bridge parabolic_bridge(double touch_n, double rupture_m) {
  Bridge bridge;
  bridge.shape = BridgeShape::polynomial;
  bridge.a_n_m2 = touch_n / (rupture_m * rupture_m);
  bridge.b_n_m = 2 * touch_n / rupture_m;
  bridge.c_n = touch_n;
  bridge.d_c_m = -rupture_m;
  bridge.offset_m = 0.5 * rupture_m;
  return bridge;
}

}  // namespace pastefit
