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

#include "calibrate/evaluate/objective.h"

namespace pastefit {

/// With which grains a candidate is simulated.
enum class Fidelity {
  fine,   ///< the study's
  coarse  ///< `low_fidelity.h`
};

/// What a search asks for: one point on one packing, in every test that is fitted.
struct Candidate {
  std::size_t number = 0;  ///< in the order of asking, from 0
  UnitPoint point;
  std::uint64_t packing = 0;
  Fidelity fidelity = Fidelity::fine;
  bool may_end_early = false;  ///< see `Objective::try_out`
  std::string purpose;         ///< the phase of the search: "screening", "search", "refinement", "confirmation"
};

/// What a simulation of a candidate answered.
struct CandidateResult {
  std::size_t candidate = 0;  ///< its number
  Evaluation evaluation;
};

/// Between the phases of a search, which ask, and whoever simulates: what is asked, and what was answered. A phase sees
/// an answer when everything that it waits for is there, never before, so that what it does depends on the answers and
/// the order of asking only. Each candidate is asked once. No call waits.
class CandidateQueue {
 public:
  /// `simulations`: allowed in all. `known`: answers of an earlier search with the same queue.
  CandidateQueue(const Scoring& scoring, int simulations, std::span<const CandidateResult> known);

  // For the phases.
  const Scoring& scoring() const { return scoring_; }
  /// Points on a packing still allowed, by the answers that were looked at.
  int budget_left() const { return std::max(0, simulations_ - spent_) / scoring_.simulations_each(); }
  bool stop_requested() const { return stopped_; }
  /// The purpose of what is asked from now on.
  void enter(std::string_view purpose) { purpose_ = purpose; }
  /// Asks for each point on each packing what is not known yet; the numbers of these candidates, point by point.
  std::vector<std::size_t> ask(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                               Fidelity fidelity, bool may_end_early);
  /// Whether these candidates are answered, or will not be after a stop.
  bool is_answered(std::span<const std::size_t> numbers) const;
  /// Their answers: what is looked at counts as spent. Requirement: `is_answered`.
  std::vector<Evaluation> answers(std::span<const std::size_t> numbers);

  // For whoever simulates; see `Search`.
  std::vector<Candidate> suggest(std::size_t count);
  void ingest(std::span<const CandidateResult> results);
  void stop() { stopped_ = true; }
  std::vector<CandidateResult> results() const;

 private:
  struct Asked {
    Candidate candidate;
    Evaluation answer;
    bool answered = false, seen = false;
  };
  using Key = std::tuple<std::vector<double>, std::uint64_t, Fidelity, bool>;

  std::size_t ask(const UnitPoint& point, std::uint64_t packing, Fidelity fidelity, bool may_end_early);
  const Evaluation& see(std::size_t number);
  void accept(const CandidateResult& result);

  const Scoring& scoring_;
  const int simulations_;
  int spent_ = 0;
  std::string purpose_;
  std::deque<Asked> asked_;
  std::map<Key, std::size_t> numbers_;
  std::map<std::size_t, Evaluation> known_;  // answers to questions still to be asked
  std::deque<std::size_t> open_;             // asked, and not yet suggested
  bool stopped_ = false;
};

}  // namespace pastefit
