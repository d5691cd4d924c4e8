#pragma once

#include <span>
#include <vector>

namespace pastefit {

/// Grain sizes as a few classes, for programs whose contact parameters belong to types of grains.
struct SizeClasses {
  std::vector<double> radii_m;  ///< one for each class, ascending
  std::vector<int> class_of;    ///< of each grain
  double largest_change = 0;    ///< of a grain's radius when it takes that of its class, relative
};

/// At most `most` classes of equal width between the smallest and the largest radius, empty ones left out. The radius
/// of a class is the one that keeps the volume of its grains. One class, exactly, if all radii are the same.
SizeClasses size_classes(std::span<const double> radii_m, int most = 8);

}  // namespace pastefit
