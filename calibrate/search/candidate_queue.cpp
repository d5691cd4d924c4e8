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

CandidateQueue::CandidateQueue(const Scoring& scoring, int simulations, std::span<const CandidateResult> known)
    : scoring_(scoring), simulations_(simulations) {
  for (const CandidateResult& one : known) known_.emplace(one.candidate, one.evaluation);
}

bool CandidateQueue::stop_requested() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

void CandidateQueue::enter(std::string_view purpose) {
  const std::lock_guard lock(mutex_);
  purpose_ = purpose;
}

std::size_t CandidateQueue::ask(const UnitPoint& point, std::uint64_t packing, Fidelity fidelity, bool may_end_early) {
  const std::vector<double> place(point.begin(), point.end());
  // One that might have ended early and did not is as good as one that might not.
  for (const bool early : {may_end_early, true})
    if (const auto known = numbers_.find({place, packing, fidelity, early}); known != numbers_.end()) {
      const Asked& asked = asked_[known->second];
      if (early == may_end_early || (asked.seen && !asked.answer.censored)) return known->second;
    }
  const std::size_t number = asked_.size();
  numbers_[{place, packing, fidelity, may_end_early}] = number;
  asked_.push_back({{number, point, packing, fidelity, may_end_early, purpose_}, {}, false, false});
  if (const auto told = known_.find(number); told != known_.end()) {
    accept({number, told->second});
    known_.erase(told);
  } else {
    open_.push_back(number);
    changed_.notify_all();
  }
  return number;
}

void CandidateQueue::begin(const UnitPoint& point, std::span<const std::uint64_t> packings) {
  const std::lock_guard lock(mutex_);
  for (const std::uint64_t packing : packings) (void)ask(point, packing, Fidelity::fine, true);
}

std::vector<std::vector<Evaluation>> CandidateQueue::evaluate(std::span<const UnitPoint> points,
                                                              std::span<const std::uint64_t> packings,
                                                              Fidelity fidelity, bool may_end_early) {
  std::unique_lock lock(mutex_);
  std::vector<std::size_t> numbers;
  for (const UnitPoint& point : points)
    for (const std::uint64_t packing : packings) numbers.push_back(ask(point, packing, fidelity, may_end_early));
  awaited_ = numbers;
  changed_.notify_all();
  changed_.wait(lock, [&] { return closed_ || !is_waiting(); });
  awaited_.clear();
  if (closed_) throw Closed{};
  std::vector<std::vector<Evaluation>> answers;
  auto next = numbers.begin();
  for (std::size_t i = 0; i < points.size(); ++i) {
    answers.emplace_back();
    for (std::size_t k = 0; k < packings.size(); ++k) answers.back().push_back(see(*next++));
  }
  return answers;
}

/// Counts what was spent when it is looked at for the first time.
const Evaluation& CandidateQueue::see(std::size_t number) {
  Asked& asked = asked_[number];
  if (!asked.answered) asked.answer = not_simulated(asked.candidate);
  if (!std::exchange(asked.seen, asked.answered) && asked.answered && asked.candidate.fidelity == Fidelity::fine)
    spent_ += asked.answer.simulations;
  return asked.answer;
}

bool CandidateQueue::is_waiting() const {
  return !stopped_ && std::ranges::any_of(awaited_, [&](std::size_t number) { return !asked_[number].answered; });
}

void CandidateQueue::accept(const CandidateResult& result) {
  if (result.candidate >= asked_.size()) throw std::logic_error("ingest: an answer to what was never suggested");
  Asked& asked = asked_[result.candidate];
  const Evaluation& answer = result.evaluation;
  if (answer.point != asked.candidate.point || answer.packing != asked.candidate.packing)
    throw std::logic_error("ingest: an answer of another point or packing than was suggested");
  if (asked.answered) return;
  asked.answer = answer;
  asked.answered = true;
}

void CandidateQueue::finish() {
  const std::lock_guard lock(mutex_);
  finished_ = true;
  changed_.notify_all();
}

std::vector<Candidate> CandidateQueue::suggest(std::size_t count) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return finished_ || !open_.empty() || (!awaited_.empty() && is_waiting()); });
  std::vector<Candidate> candidates;
  for (; candidates.size() < count && !open_.empty(); open_.pop_front())
    candidates.push_back(asked_[open_.front()].candidate);
  return candidates;
}

void CandidateQueue::ingest(std::span<const CandidateResult> results) {
  const std::lock_guard lock(mutex_);
  for (const CandidateResult& result : results) accept(result);
  changed_.notify_all();
}

void CandidateQueue::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

void CandidateQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

bool CandidateQueue::finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

std::vector<CandidateResult> CandidateQueue::results() const {
  const std::lock_guard lock(mutex_);
  std::vector<CandidateResult> results;
  for (const Asked& asked : asked_)
    if (asked.answered) results.push_back({asked.candidate.number, asked.answer});
  for (const auto& [number, evaluation] : known_) results.push_back({number, evaluation});
  return results;
}

}  // namespace pastefit
