#pragma once

#include <cmath>

#include "core/laws/pack.h"
#include "core/vec3.h"

namespace pastefit {

/// The space of the grains: unbounded, or a slice that is periodic along x, so that grains that leave at one side enter
/// at the other. The only place where distances between grains are computed.
///
/// Grains are moved back into 0 <= x < period when they are sorted; in between they may be outside by their
/// displacement. Walls are not moved back: they must look the same one period farther.
/// Requirement: no two grains interact across more than half a period.
struct Domain {
  double period = 0;  ///< along x [m]; 0: not periodic, at no cost

  bool repeats() const { return period > 0; }

  /// Vector from one place to the nearest image of another, for places less than one and a half periods apart [m].
  template <class Real>
  PASTEFIT_INLINE BasicVec3<Real> minimum_image(const BasicVec3<Real>& from, const BasicVec3<Real>& to) const {
    return shortest(to - from);
  }
  template <class Real>
  PASTEFIT_INLINE BasicVec3<Real> shortest(BasicVec3<Real> between) const {
    if (period > 0) {
      const Real whole(period), half(0.5 * period), zero(0.0);
      between.x = between.x - select(between.x > half, whole, select(between.x < -half, -whole, zero));
    }
    return between;
  }

  /// Image of a place inside the slice.
  Vec3 put_back(const Vec3& place) const {
    if (!repeats()) return place;
    return {place.x - period * std::floor(place.x / period), place.y, place.z};
  }
};

}  // namespace pastefit
