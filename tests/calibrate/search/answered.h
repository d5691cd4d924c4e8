#pragma once

#include <limits>
#include <thread>

#include "calibrate/search/questions.h"

namespace pastefit::synthetic {

/// Questions that an objective answers in a thread of its own, so that parts of a strategy can be tried by themselves.
class Answered {
 public:
  explicit Answered(Objective& objective) : questions(objective, objective.simulations_left(), {}) {
    thread_ = std::thread([this, &objective] {
      while (!questions.finished()) {
        for (const Candidate& one : questions.suggest(std::numeric_limits<std::size_t>::max())) {
          const auto how = one.may_end_early ? &Objective::try_out : &Objective::evaluate;
          const Response response = (objective.*how)({&one.point, 1}, {&one.packing, 1}).at(0);
          const CandidateResult result{one.number, response.evaluations.front()};
          questions.ingest({&result, 1});
        }
      }
    });
  }
  ~Answered() {
    questions.finish();
    thread_.join();
  }

  Questions questions;

 private:
  std::thread thread_;
};

}  // namespace pastefit::synthetic
