#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/check/check.h"

namespace pastefit {

/// A reading of a test that no search saw.
struct ReadingPrediction {
  std::string name;
  std::vector<double> of_materials;     ///< mean of each material, in their order
  double mean = 0;                      ///< of these means
  double of_heap = 0;                   ///< standard deviation of one heap about its material's mean
  double lower = 0, upper = 0;          ///< band for one measured heap
  int heaps = 0;                        ///< of a material, at most
  double of_test = 0;                   ///< standard deviation of one measured test: published, or of a heap if larger
  std::optional<Measurement> measured;  ///< by the laboratory, if the file has it

  /// How wide the materials' range of this reading is once one test has measured it, over its width now:
  ///     s/sqrt(s^2 + v^2),   v^2 = max(0, variance of the means - w^2/n),
  /// s = `of_test`, w = `of_heap`, n heaps a material: the standard deviation of a normal distribution after a
  /// measurement over that before, the scatter of the means taken off. 1: nothing is learnt.
  double width_left() const;
  bool is_within() const { return !measured || (lower <= measured->value && measured->value <= upper); }
};

struct Prediction {
  std::vector<ReadingPrediction> readings;  ///< that a laboratory would take, or took
  int heaps = 0;                            ///< simulated
  int rejected = 0;                         ///< of them such as a laboratory would repeat, which are left out
  int spilled = 0;  ///< of them such as slid off the table, by a tenth of their grains or more, whose readings then end
};

/// The probability that a band is meant to have.
inline constexpr double prediction_level = 0.9;

/// What materials that fit the card's readings leave in another test, each in as many packings, one heap of 90 %:
///     from min_k x_k - t(0.95; n - m) s to max_k x_k + t(0.95; n - m) s,
/// x_k the mean of material k, s the standard deviation of one heap, pooled over m materials and n heaps. The materials
/// are as different as the readings allow, so that their range stands for what is not known of the material; the rest
/// is the scatter of one heap. Error of the contact law and of the grains' size is not in it. `materials`: values of
/// every parameter (`values_at`), the recommended ones first. Requirements: at least one, packings >= 2. Errors: the
/// grains do not fit the test; a simulation fails.
Result<Prediction> predict(const Card& card, std::span<const std::vector<double>> materials, const Test& test,
                           std::span<const Measurement> measured, int packings, int threads,
                           const CheckEngine& engine = CheckEngine::ours());

}  // namespace pastefit
