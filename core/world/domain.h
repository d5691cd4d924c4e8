#pragma once

#include <cmath>

#include "core/laws/pack.h"
#include "core/vec3.h"

namespace pastefit {

/// The space that grains are in: all of it, or a slice of it that repeats along x, so that what leaves the slice on one
/// side comes in on the other. The one place where the distance between two grains is computed.
///
/// Grains are put back into 0 <= x < period when they are sorted, and until then may be outside by as much as they have
/// moved since. Walls are not put back: they have to look the same a period further on.
/// Requirement: no two grains may act on each other across more than half a period.
struct Domain {
  double period = 0;  ///< along x [m]; 0: nothing repeats, and nothing of it is computed

  bool repeats() const { return period > 0; }

  /// The vector from one place to the nearest image of another, of places less than one and a half periods apart [m].
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

  /// The image of a place that is in the slice.
  Vec3 put_back(const Vec3& place) const {
    if (!repeats()) return place;
    return {place.x - period * std::floor(place.x / period), place.y, place.z};
  }
};

}  // namespace pastefit
