#include "calibrate/python/asked_examination.h"

#include <algorithm>
#include <utility>

namespace pastefit::python {

AskedExamination::AskedExamination(const Answers& answers, const Calibration& found, int simulations)
    : scoring_(answers.scoring()),
      queue_(scoring_, simulations, {}),
      examination_([&answers](std::span<const Response> history) { return answers.evidence(history); }, found,
                   std::min(answers.options().examination_simulations, queue_.budget_left()), answers.options().seed) {
  queue_.enter("examination");
  advance();
}

void AskedExamination::ingest(const CandidateResult& result) {
  queue_.ingest({&result, 1});
  advance();
}

void AskedExamination::stop() {
  queue_.stop();
  advance();
}

void AskedExamination::advance() {
  while (!finished_ && queue_.is_answered(awaited_)) {
    std::vector<Response> responses;
    for (const Evaluation& one : queue_.answers(std::exchange(awaited_, {})))
      responses.push_back(scoring_.response_of({one}));
    examination_.ingest(std::move(responses));
    const auto request = examination_.next(queue_.stop_requested() ? 0 : queue_.budget_left());
    if (request)
      awaited_ = queue_.ask(request->points, {&request->packing, 1}, Fidelity::fine, false);
    else
      finished_ = true;
  }
}

}  // namespace pastefit::python
