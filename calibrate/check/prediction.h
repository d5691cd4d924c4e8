#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/check/check.h"

namespace pastefit {

/// Predicted reading of a test that no search used.
struct ReadingPrediction {
  std::string name;
  std::vector<double> of_materials;     ///< mean of each material
  double mean = 0;                      ///< of these means
  double of_heap = 0;                   ///< standard deviation of one heap about the mean of its material
  double lower = 0, upper = 0;          ///< band for one measured heap
  int heaps = 0;                        ///< largest number for one material
  double of_test = 0;                   ///< standard deviation of one measured test: published, or `of_heap` if larger
  std::optional<Measurement> measured;  ///< if in the laboratory file

  /// Width of the materials' range of this reading after one measured test, over its present width:
  ///     s/sqrt(s^2 + v^2),   v^2 = max(0, variance of the means - w^2/n),
  /// s = `of_test`, w = `of_heap`, n heaps for each material: ratio of the standard deviations of a normal distribution
  /// after and before a measurement, without the scatter of the means. 1: nothing is gained.
  double width_left() const;
  bool is_within() const { return !measured || (lower <= measured->value && measured->value <= upper); }
};

struct Prediction {
  std::vector<ReadingPrediction> readings;  ///< advised or measured ones
  int heaps = 0;                            ///< simulated
  int rejected = 0;                         ///< of them rejected; these are left out
  int failed = 0;                           ///< simulations that failed, e.g. never came to rest; these are left out
  int spilled = 0;  ///< heaps with more than 0.1 of the grains off the table; readings of these stages are left out
};

/// Nominal probability of a band.
inline constexpr double prediction_level = 0.9;

/// Predicts another test from materials that fit the card's readings, each simulated in `packings` packings. Band of
/// one heap with a probability of 90 %:
///     from min_k x_k - t(0.95; n - m) s to max_k x_k + t(0.95; n - m) s,
/// x_k: mean of material k, s: standard deviation of one heap, pooled over m materials and n heaps. `materials`: values
/// of every parameter (`values_at`), the recommended ones first. Requirements: at least one material, packings >= 2.
/// The materials should differ as much as the readings allow, so that their range represents the uncertainty of the
/// material. Limit: the band excludes errors of contact law and grain size. Errors: the grains do not fit the test; all
/// simulations fail; a stop.
Result<Prediction> predict(const Card& card, std::span<const std::vector<double>> materials, const Test& test,
                           std::span<const Measurement> measured, int packings, int threads,
                           const CheckEngine& engine = CheckEngine::ours());

}  // namespace pastefit
