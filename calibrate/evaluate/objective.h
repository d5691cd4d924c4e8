#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/study/tolerance.h"

namespace pastefit {

/// A part of the unit cube, from corner to corner.
struct UnitBox {
  UnitPoint lower, upper;
};

/// How simulations of a study are judged: shapes, tolerances, and residuals. Simulates nothing.
class Scoring {
 public:
  virtual ~Scoring() = default;
  virtual int parameters() const = 0;
  virtual int residuals() const = 0;
  /// How many of them are readings: the first ones. The others stand for what is known beforehand (priors).
  virtual int readings() const { return residuals(); }
  /// How far off a reading may be, in its unit.
  virtual double tolerance(std::size_t) const { return 1; }
  /// The residual of a reading that is off by just that; 0: it is not fitted.
  virtual double allowance(std::size_t) const { return 1; }
  /// In which people are told what a candidate misses by.
  virtual ErrorUnit error_unit() const { return {}; }
  /// What share of a candidate's heaps a laboratory may reject; 1: it is not judged.
  virtual double rejected_share() const { return 1; }
  /// Where a screening looks, by what is known before anything was simulated; a search goes beyond where that promises
  /// more.
  virtual UnitBox likely_box() const { return {UnitPoint::Zero(parameters()), UnitPoint::Ones(parameters())}; }
  /// Simulations behind a point on one packing: one for each test that is fitted.
  virtual int simulations_each() const { return 1; }
  /// What one candidate answers on the packings of these evaluations. Requirement: at least one.
  virtual Response response_of(std::vector<Evaluation> evaluations) const = 0;
};

/// The only door from the search to the simulations. Implementations evaluate in parallel and keep a record.
/// Guarantee: the answer depends on (point, packings) only, not on threads, order or what was asked before.
class Objective : public virtual Scoring {
 public:
  /// Answers all points on the same packings; the answers are in the order of the points.
  /// Points outside the unit cube are a programming error (checked).
  virtual std::vector<Response> evaluate(std::span<const UnitPoint> points,
                                         std::span<const std::uint64_t> packings) = 0;
  /// The same for candidates that only have to be told from good ones: a simulation may end where they have lost,
  /// and need not look for energy that it creates: that is seen where nothing was tried, as on a confirmation's
  /// packings. Nothing but what is left out differs from the answer of `evaluate`.
  virtual std::vector<Response> try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) {
    return evaluate(points, packings);
  }
  /// Begins to work on points without waiting for the answers, if it can; `try_out`, or `evaluate` if they may not end
  /// early, waits for them. Changes no answer, and counts in the budget only when they are asked for.
  virtual void begin(std::span<const UnitPoint>, std::span<const std::uint64_t>, bool /*may_end_early*/) {}
  /// Points on a packing still allowed by the budget, each counted once, however often it is asked.
  virtual int budget_left() const = 0;
  /// The same in simulations.
  virtual int simulations_left() const { return budget_left() * simulations_each(); }
  /// What is known from the start, each point on one packing; free of charge.
  virtual std::vector<Response> earlier() const { return {}; }
  /// True when the user or a limit asked to stop: a search then returns its best so far.
  virtual bool stop_requested() const = 0;
};

}  // namespace pastefit
