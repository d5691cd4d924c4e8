#pragma once

#include <limits>
#include <thread>

#include "calibrate/search/candidate_queue.h"

namespace pastefit::synthetic {

/// CandidateQueue that an objective answers in a thread of its own, so that parts of a strategy can be tried by
/// themselves.
class Answered {
 public:
  explicit Answered(Objective& objective) : queue(objective, objective.simulations_left(), {}) {
    thread_ = std::thread([this, &objective] {
      while (!queue.finished()) {
        for (const Candidate& one : queue.suggest(std::numeric_limits<std::size_t>::max())) {
          const auto how = one.may_end_early ? &Objective::try_out : &Objective::evaluate;
          const Response response = (objective.*how)({&one.point, 1}, {&one.packing, 1}).at(0);
          const CandidateResult result{one.number, response.evaluations.front()};
          queue.ingest({&result, 1});
        }
      }
    });
  }
  ~Answered() {
    queue.finish();
    thread_.join();
  }

  CandidateQueue queue;

 private:
  std::thread thread_;
};

}  // namespace pastefit::synthetic
