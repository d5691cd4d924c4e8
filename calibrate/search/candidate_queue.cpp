#include "calibrate/search/candidate_queue.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pastefit {
namespace {

Evaluation not_simulated(const Candidate& candidate) {
  Failure failure;
  failure.reason = FailureReason::stopped;
  failure.message = "The calibration was ended before this simulation; go on with --resume.";
  return {candidate.point, candidate.packing, {}, failure, false, 0};
}

}  // namespace

std::size_t CandidateQueue::ask(const UnitPoint& point, std::uint64_t packing, Fidelity fidelity, bool may_end_early) {
  const std::vector<double> place(point.begin(), point.end());
  // A run that could have ended early but did not equals a complete run.
  for (const bool early : {may_end_early, true})
    if (const auto known = numbers_.find({place, packing, fidelity, early}); known != numbers_.end()) {
      const Asked& asked = asked_[known->second];
      if (early == may_end_early || (asked.seen && !asked.answer.censored)) return known->second;
    }
  const std::size_t number = asked_.size();
  numbers_[{place, packing, fidelity, may_end_early}] = number;
  asked_.push_back({{number, point, packing, fidelity, may_end_early, purpose_}, {}, false, false});
  open_.push_back(number);
  return number;
}

std::vector<std::size_t> CandidateQueue::ask(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                             Fidelity fidelity, bool may_end_early) {
  std::vector<std::size_t> numbers;
  for (const UnitPoint& point : points)
    for (const std::uint64_t packing : packings) numbers.push_back(ask(point, packing, fidelity, may_end_early));
  return numbers;
}

bool CandidateQueue::is_answered(std::span<const std::size_t> numbers) const {
  return stopped_ || std::ranges::all_of(numbers, [&](std::size_t number) { return asked_[number].answered; });
}

std::vector<Evaluation> CandidateQueue::answers(std::span<const std::size_t> numbers) {
  std::vector<Evaluation> answers;
  for (const std::size_t number : numbers) {
    Asked& asked = asked_[number];
    if (!asked.answered) asked.answer = not_simulated(asked.candidate);
    // The simulations count as spent when the answer is read first.
    if (!std::exchange(asked.seen, asked.answered) && asked.answered && asked.candidate.fidelity == Fidelity::fine)
      spent_ += asked.answer.simulations;
    answers.push_back(asked.answer);
  }
  return answers;
}

std::vector<Candidate> CandidateQueue::suggest(std::size_t count) {
  std::vector<Candidate> candidates;
  for (; candidates.size() < count && !open_.empty(); open_.pop_front())
    candidates.push_back(asked_[open_.front()].candidate);
  return candidates;
}

void CandidateQueue::ingest(std::span<const CandidateResult> results) {
  for (const CandidateResult& result : results) {
    if (result.candidate >= asked_.size()) throw std::logic_error("ingest: an answer to what was never suggested");
    Asked& asked = asked_[result.candidate];
    const Evaluation& answer = result.evaluation;
    if (answer.point != asked.candidate.point || answer.packing != asked.candidate.packing)
      throw std::logic_error("ingest: an answer of another point or packing than was suggested");
    if (asked.answered) continue;
    asked.answer = answer;
    asked.answered = true;
  }
}

}  // namespace pastefit
