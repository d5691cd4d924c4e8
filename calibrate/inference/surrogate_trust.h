#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibrate/inference/training_data.h"
#include "calibrate/models/reading_model.h"
#include "calibrate/models/replicates.h"

namespace pastefit {

/// Detects discontinuities by leave-one-out errors of the smooth models: a heap may keep its shape or collapse after a
/// small change of a parameter. A site is doubtful if leaving it out gives an error of more than ten standard
/// deviations of the measurement (three if one parameter is free) and of more than four standard deviations between
/// packings of one candidate. Between two simulations on either side of a jump, only their readings bound the response.
class SurrogateTrust {
 public:
  /// `models`: of all readings. `fitted`: indices of those that are tested.
  SurrogateTrust(const TrainingData& evidence, const Sites& sites, std::span<const ReadingModel> models,
                 std::span<const std::size_t> fitted);

  /// True if none of the sites nearest to the point is doubtful.
  bool predicts(const UnitPoint& point) const;
  /// True if one parameter is free and some site is doubtful: intervals between neighbours then replace the model.
  bool uses_neighbours() const { return uses_neighbours_; }
  /// Log-likelihood of a single parameter without a model: each fitted reading may take any value between those of the
  /// neighbours; beyond the outermost site it has the value there. 0, its maximum, for several parameters.
  double log_likelihood(double coordinate) const;
  /// Sorted coordinates of the sites of one parameter.
  std::vector<double> coordinates() const;

 private:
  struct Neighbour {
    double coordinate = 0;
    std::vector<double> means;      // of the fitted readings
    std::vector<double> weights;    // number of simulations of each
    std::vector<double> variances;  // of those means and the measured ones together
  };
  void line_up(const TrainingData& evidence, const Sites& sites, std::span<const double> scatter,
               std::span<const std::size_t> fitted);

  std::vector<UnitPoint> places_;
  std::vector<bool> doubtful_;
  bool any_doubtful_ = false, uses_neighbours_ = false;
  std::vector<Neighbour> line_;
  std::vector<double> measured_;
};

}  // namespace pastefit
