#pragma once

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

  /// None if nothing promises more than a fiftieth of the misfit or of the tolerances, or before the next answer.
  std::optional<UnitPoint> next(const CandidateRanking& ranking);

 private:
  UnitPoint tried_with_coarse_grains(UnitPoint proposal);
  void fantasise_answers(Surrogate& model) const;

  EvaluationHistory& history_;
  bool with_coarse_;
  const SearchOptions& options_;
};

}  // namespace pastefit
