#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/study/tolerance.h"

namespace pastefit {

/// Axis-aligned box in the unit cube.
struct UnitBox {
  UnitPoint lower, upper;
};

/// Scores simulations of a study: shapes, tolerances and residuals. Simulates nothing.
class Scoring {
 public:
  virtual ~Scoring() = default;
  virtual int parameters() const = 0;
  virtual int residuals() const = 0;
  /// Number of residuals that are readings; these come first, the others are priors.
  virtual int readings() const { return residuals(); }
  /// Largest accepted difference of a reading, in its unit.
  virtual double tolerance(std::size_t) const { return 1; }
  /// Residual of a reading that differs by its tolerance; 0: not fitted.
  virtual double allowance(std::size_t) const { return 1; }
  /// Unit of errors in messages.
  virtual ErrorUnit error_unit() const { return {}; }
  /// Largest accepted share of rejected heaps; 1: not judged.
  virtual double rejected_share() const { return 1; }
  /// Box of the screening, from prior knowledge; the search may leave it.
  virtual UnitBox likely_box() const { return {UnitPoint::Zero(parameters()), UnitPoint::Ones(parameters())}; }
  /// Simulations of a point on one packing: one for each fitted test.
  virtual int simulations_each() const { return 1; }
  /// Response of one candidate to the packings of these evaluations. Requirement: at least one.
  virtual Response response_of(std::vector<Evaluation> evaluations) const = 0;
};

}  // namespace pastefit
