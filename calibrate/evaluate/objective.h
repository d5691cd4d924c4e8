#pragma once

#include <cstdint>
#include <span>
#include <string_view>
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

/// Interface between the search and the simulations. Implementations evaluate in parallel and keep a record. Guarantee:
/// the answer depends on (point, packings) only, not on threads, order or earlier requests.
class Objective : public virtual Scoring {
 public:
  /// Simulates all points on the same packings; returns the responses in the order of the points. Points outside the
  /// unit cube are a programming error (checked).
  virtual std::vector<Response> evaluate(std::span<const UnitPoint> points,
                                         std::span<const std::uint64_t> packings) = 0;
  /// The same for candidates that need no complete result: a simulation may end as soon as the candidate is clearly
  /// worse, and omits the energy balance, which confirmations check on other packings. The readings that it takes equal
  /// those of `evaluate`.
  virtual std::vector<Response> try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) {
    return evaluate(points, packings);
  }
  /// Starts points without waiting, if possible; `try_out`, or `evaluate` if they may not end early, then waits. It
  /// changes no answer; points count in the budget only when requested.
  virtual void begin(std::span<const UnitPoint>, std::span<const std::uint64_t>, bool /*may_end_early*/) {}
  /// Remaining budget in points on a packing, each counted once however often it is requested.
  virtual int budget_left() const = 0;
  /// The same in simulations.
  virtual int simulations_left() const { return budget_left() * simulations_each(); }
  /// Responses known at the start, each on one packing; not counted in the budget.
  virtual std::vector<Response> earlier() const { return {}; }
  /// True after a stop request of the user or a limit: a search then returns its best so far.
  virtual bool stop_requested() const = 0;
};

}  // namespace pastefit
