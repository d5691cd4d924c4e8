#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "calibrate/search/candidate_ranking.h"

namespace pastefit {

/// Points closer than this in every coordinate are the same candidate [unit cube].
inline constexpr double same_point = 0.01;

/// Acquisition of the default strategy: the point of largest expected improvement on the least expected misfit
/// (`maximise_expected_improvement`). If that improvement is negligible, the point of largest expected margin
/// (`CandidateRanking::expected_margin`), if this margin, that of the worst reading, exceeds the best candidate's. A
/// proposal closer than `same_point` to a known point is that point on another packing.
///
/// Pending candidates enter the surrogate with fantasised means (Snoek, Larochelle & Adams 2012, section 3.2, with one
/// draw), so that the next proposal is made for a plausible outcome. The draw of a candidate is always the same.
/// Replicate scatter is left out, because it would scatter the proposals.
///
/// With coarse grains, a proposal is first simulated with these, and moved until no point is better within the noise.
///
/// Requirement: the arguments of the constructor outlive the object.
class Proposals {
 public:
  Proposals(EvaluationHistory& history, bool with_coarse, const SearchOptions& options)
      : history_(history), with_coarse_(with_coarse), options_(options) {}

  /// Computes the next point. Returns false if it requested coarse simulations; call it again with the same ranking.
  bool look(const CandidateRanking& ranking);
  /// The point; none if the expected gain is below 0.02 of the misfit or of the tolerances, or before the next answer.
  const std::optional<UnitPoint>& found() const { return found_; }

 private:
  /// Maximiser of the acquisition, if its gain is large enough.
  std::optional<UnitPoint> promising(const CandidateRanking& ranking) const;
  /// Moves the proposal to the optimum with coarse grains; false if it requested a simulation.
  bool try_with_coarse_grains();
  /// `proposal`, or the known point that it is close to; none if that point is pending.
  std::optional<UnitPoint> distinct(const UnitPoint& proposal) const;
  void fantasise_answers(Surrogate& model) const;

  EvaluationHistory& history_;
  bool with_coarse_;
  const SearchOptions& options_;
  std::optional<UnitPoint> proposal_;  // under test with coarse grains
  int coarse_tries_ = 0;
  std::optional<std::size_t> coarse_known_;  // number of coarse simulations before the request
  std::optional<UnitPoint> found_;
};

}  // namespace pastefit
