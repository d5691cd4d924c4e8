#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibrate/inference/training_data.h"
#include "calibrate/models/reading_model.h"
#include "calibrate/models/replicates.h"

namespace pastefit {

/// Where a smooth model of the fitted readings does not predict simulations that were left out of it: a heap that
/// stands or flows by a small change of a parameter. Two simulations on either side of such a jump say that the
/// reading lies somewhere between, and nothing smooth says more. A site is doubtful if leaving it out misses it by
/// more than ten of the laboratory's standard deviations (three where one parameter is free) and four of the scatter
/// between packings of one candidate.
class SurrogateTrust {
 public:
  /// `models`: of all readings. `fitted`: those that are judged.
  SurrogateTrust(const TrainingData& evidence, const Sites& sites, std::span<const ReadingModel> models,
                 std::span<const std::size_t> fitted);

  /// Whether the model may predict this point: none of the sites nearest to it is doubtful.
  bool predicts(const UnitPoint& point) const;
  /// Where one parameter is free: some site is doubtful, and what lies between neighbours takes the place of the model.
  bool uses_neighbours() const { return uses_neighbours_; }
  /// The logarithm of the likelihood of a single parameter without a model: between neighbours each fitted reading may
  /// be anything between theirs, beyond the outermost it is theirs. 0, which is all that can be, for several
  /// parameters.
  double log_likelihood(double coordinate) const;
  /// Coordinates of the sites of one parameter, in order.
  std::vector<double> coordinates() const;

 private:
  struct Neighbour {
    double coordinate = 0;
    std::vector<double> means;      // of the fitted readings
    std::vector<double> weights;    // simulations of each
    std::vector<double> variances;  // of those means and of the laboratory's
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
