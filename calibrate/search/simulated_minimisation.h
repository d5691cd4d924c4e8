#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "calibrate/optimisers/problem.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// An optimiser on the simulations themselves, on all common packings. Optimisers call back and cannot wait: where one
/// asks for what is not known it is ended, and run again from its start once that is answered, with the answers of
/// before. So it has to ask the same questions for the same answers, as those of `calibrate/optimisers` do; what an
/// optimiser computes itself is nothing beside a simulation.
class SimulatedMinimisation : public SearchPhase {
 public:
  /// `minimise`: runs the optimiser on the problem that it is given. A candidate whose error is at or below `goal` is
  /// good enough; 0: none is.
  SimulatedMinimisation(StrategyState& state, double goal, std::function<void(const Problem&)> minimise)
      : state_(state), goal_(goal), minimise_(std::move(minimise)) {}
  bool advance() override;

 private:
  std::vector<Answer> answers_of(std::span<const Response> responses) const;
  std::optional<Problem::Refusal> refusal_of(int points) const;

  StrategyState& state_;
  const double goal_;
  const std::function<void(const Problem&)> minimise_;
  bool asked_ = false;
  std::vector<std::vector<Answer>> answers_;               // to its questions so far, in order
  std::vector<std::optional<Problem::Refusal>> refusals_;  // whether they were allowed, as it was decided then
};

}  // namespace pastefit
