#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

/// One run of the stress campaign: a slump test somewhere in the admissible box.
struct StressCase {
  int number = 0;
  SlumpTest test;
  double enlarged = 0;   ///< share by which the radii of the filled mould grow before the test: grains start in overlap
  double weights = 0;    ///< attraction at touch over the weight of a grain of mean radius
  double gap_ratio = 0;  ///< -d_c/R
  double size_ratio = 1;
  double plate_deg = 0;  ///< 0: without step 2
  /// A candidate as a search tries it, without asking whether its grains are too soft for their attraction.
  bool searched = false;
  bool keeps_energy = false;  ///< energy created is a defect, not an end like others
};

/// Number of corner cases; they have the first numbers, the Sobol points follow.
constexpr int kCorners = 64;

/// The cases `first` .. `first + count - 1`; a pure function of its arguments.
///
/// Corners: every combination of the ends of modulus, attraction, lift velocity, restitution, size ratio and friction,
/// the rest drawn. Others: a Sobol sequence over all coordinates, shifted by a number drawn from `seed`; logarithmic
/// where a range spans decades.
/// Every case is admissible: `validate(test)` is empty.
std::vector<StressCase> stress_cases(int first, int count, std::uint64_t seed);

/// A slump in a small cone of equal grains, each case with a packing of its own.
SlumpTest small_cone(int number, double grain_radius_m);

/// Name and value of everything in which cases differ, so that a case can be repeated without this program.
std::vector<std::pair<std::string, std::string>> inputs_of(const StressCase& stress);

}  // namespace pastefit
