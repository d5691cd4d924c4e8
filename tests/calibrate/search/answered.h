#pragma once

#include <limits>
#include <vector>

#include "calibrate/search/strategy_state.h"
#include "tests/calibrate/search/objective.h"

namespace pastefit::synthetic {

/// CandidateQueue that an objective answers, so that parts of a strategy can be tried by themselves.
class Answered {
 public:
  explicit Answered(Objective& objective) : queue(objective, objective.simulations_left()), objective_(objective) {}

  /// The answers to what the history awaits.
  const std::vector<Response>& answers_of(EvaluationHistory& history) {
    for (const Candidate& one : queue.suggest(std::numeric_limits<std::size_t>::max())) {
      const auto how = one.may_end_early ? &Objective::try_out : &Objective::evaluate;
      const Response response = (objective_.*how)({&one.point, 1}, {&one.packing, 1}).at(0);
      const CandidateResult result{one.number, response.evaluations.front()};
      queue.ingest({&result, 1});
    }
    history.take_answers();
    return history.answers();
  }

  /// A phase from its beginning to its end.
  void run(SearchPhase& phase, EvaluationHistory& history) {
    while (!phase.advance()) answers_of(history);
  }

  CandidateQueue queue;

 private:
  Objective& objective_;
};

}  // namespace pastefit::synthetic
