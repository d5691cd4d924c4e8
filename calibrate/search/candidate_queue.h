#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "calibrate/evaluate/response.h"

namespace pastefit {

/// Grain size of a simulation.
enum class Fidelity {
  fine,   ///< of the study
  coarse  ///< see `surrogate.h`
};

/// One point on one packing, to be simulated in every fitted test.
struct Candidate {
  std::size_t number = 0;  ///< in the order of asking, from 0
  UnitPoint point;
  std::uint64_t packing = 0;
  Fidelity fidelity = Fidelity::fine;
  bool may_end_early = false;  ///< see `Simulation::may_end_early`
  std::string purpose;         ///< phase of the search: "screening", "search", "refinement", "confirmation"
};

struct CandidateResult {
  std::size_t candidate = 0;  ///< `Candidate::number`
  Evaluation evaluation;
};

/// Queue between the phases of a search and the simulators. Each candidate is requested once. A phase gets its answers
/// only after all of them have arrived, so that the search depends on the answers and the order of asking, not on their
/// timing. No call blocks.
class CandidateQueue {
 public:
  /// `simulations`: total allowed.
  CandidateQueue(const Scoring& scoring, int simulations) : scoring_(scoring), simulations_(simulations) {}

  // For the phases.
  const Scoring& scoring() const { return scoring_; }
  /// Remaining simulations of a point on a packing; an answer counts as spent only when a phase has read it.
  int budget_left() const { return std::max(0, simulations_ - spent_) / scoring_.simulations_each(); }
  bool stop_requested() const { return stopped_; }
  /// Sets the purpose of later candidates.
  void enter(std::string_view purpose) { purpose_ = purpose; }
  /// Enqueues each point on each packing unless it is already known. Returns the candidate numbers, point by point.
  std::vector<std::size_t> ask(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                               Fidelity fidelity, bool may_end_early);
  /// True if these candidates are answered or a stop was requested.
  bool is_answered(std::span<const std::size_t> numbers) const;
  /// Answers of these candidates, which count as spent from now on. Requirement: `is_answered`.
  std::vector<Evaluation> answers(std::span<const std::size_t> numbers);

  // For the simulators; see `Search`.
  std::vector<Candidate> suggest(std::size_t count);
  void ingest(std::span<const CandidateResult> results);
  void stop() { stopped_ = true; }

 private:
  struct Asked {
    Candidate candidate;
    Evaluation answer;
    bool answered = false, seen = false;
  };
  using Key = std::tuple<std::vector<double>, std::uint64_t, Fidelity, bool>;

  std::size_t ask(const UnitPoint& point, std::uint64_t packing, Fidelity fidelity, bool may_end_early);

  const Scoring& scoring_;
  const int simulations_;
  int spent_ = 0;
  std::string purpose_;
  std::deque<Asked> asked_;
  std::map<Key, std::size_t> numbers_;
  std::deque<std::size_t> open_;  // asked, not yet suggested
  bool stopped_ = false;
};

}  // namespace pastefit
