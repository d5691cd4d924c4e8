#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "calibrate/search/candidate_ranking.h"

namespace pastefit {

/// Points closer than this in every coordinate are the same candidate [unit cube].
inline constexpr double same_point = 0.01;

/// What the default strategy tries next: the point that is expected to improve most on the least expected misfit so far
/// (`maximise_expected_improvement`), so that promise is weighed against uncertainty. Where the misfit promises nothing
/// any more, the point of the largest expected margin (`CandidateRanking::expected_margin`), if it is larger than the
/// best candidate's: a candidate has to meet each reading and not their sum. One that is a known point is that point
/// again, on another packing.
///
/// Of a candidate under way only the point is known. It counts in the surrogate with an answer drawn from what is known
/// of its mean, always the same draw for the same candidate, so that the next proposal is made for a case that may well
/// come (Snoek, Larochelle & Adams 2012, section 3.2, with one draw; the noise of the packings is left out, because it
/// would scatter the proposals).
///
/// With coarse grains each proposal is the first such point that has been tried there and is still as good as any, as
/// far as the noise lets tell.
///
/// Requirement: what the constructor is given outlives the object.
class Proposals {
 public:
  Proposals(EvaluationHistory& history, bool with_coarse, const SearchOptions& options)
      : history_(history), with_coarse_(with_coarse), options_(options) {}

  /// Looks for the next point. False: it asked for coarse simulations, and is to be called again with the same ranking.
  bool look(const CandidateRanking& ranking);
  /// What was found: none if nothing promises more than a fiftieth of the misfit or of the tolerances, or before the
  /// next answer.
  const std::optional<UnitPoint>& found() const { return found_; }

 private:
  /// The point of most promise, if it promises enough.
  std::optional<UnitPoint> promising(const CandidateRanking& ranking) const;
  /// Moves the proposal to where coarse grains see none better; false if it asked for a simulation.
  bool try_with_coarse_grains();
  /// None if it is under way already, and what was answered as the same point.
  std::optional<UnitPoint> distinct(const UnitPoint& proposal) const;
  void fantasise_answers(Surrogate& model) const;

  EvaluationHistory& history_;
  bool with_coarse_;
  const SearchOptions& options_;
  std::optional<UnitPoint> proposal_;  // that is tried with coarse grains
  int coarse_tries_ = 0;
  std::optional<std::size_t> coarse_known_;  // simulations before the one that was asked for
  std::optional<UnitPoint> found_;
};

}  // namespace pastefit
