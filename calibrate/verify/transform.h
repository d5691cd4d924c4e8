#pragma once

#include "core/apparatus/impact/impact.h"

namespace pastefit {

/// Ways to look at the same experiment that change nothing but what they must.
enum class Transform {
  shift,     ///< everything elsewhere
  turn,      ///< about the vertical
  mirror,    ///< y against -y
  boost,     ///< seen from a frame in constant motion; for scenes without weight and held grains
  lengthen,  ///< all lengths three times as long, at equal speeds and stresses: times grow alike, bridges by their
             ///< scaling
};

/// The experiment as it is seen after the transformation.
Impact transformed(const Impact& test, Transform transform);

/// By how much the ends of both experiments differ beyond the transformation: the largest difference of a velocity (a
/// spin times its radius counts as one), over the largest velocity.
double difference(const Impact& test, const Outcome& before, Transform transform, const Outcome& after);

}  // namespace pastefit
