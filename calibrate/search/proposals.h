#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "calibrate/search/archive.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

/// Points closer than this in every coordinate are the same candidate [unit cube].
inline constexpr double same_point = 0.01;

/// What the default strategy tries next on the common packings: the point of least expected misfit. The misfit expected
/// at a point is half the sum of squared mean residuals and of their variances, so promise is weighed against doubt.
///
/// Of a candidate under way only the point is known. It counts in the surrogate with an answer drawn from what is known
/// of its mean, always the same draw for the same candidate, so that the next proposal is made for a case that may well
/// come (Snoek, Larochelle & Adams 2012, section 3.2, with one draw; the noise of the packings is left out, because it
/// would scatter the proposals). Where a drawn answer meets the goal, or the next
/// candidate would be one that was asked already, there is no proposal before the next answer.
///
/// With a coarse rung each proposal is the first such point that has been tried there and is still as good as any, as
/// far as the noise lets tell.
///
/// Requirements: some evidence is feasible. `common` and the others outlive the object.
class Proposals {
 public:
  /// `goal`: miss at which a candidate is good enough.
  Proposals(Archive& archive, Objective* coarse, const SearchOptions& options, std::span<const std::uint64_t> common,
            double goal)
      : archive_(archive), coarse_(coarse), options_(options), common_(common), goal_(goal) {}

  /// None if nothing new comes to mind before the next answer.
  std::optional<UnitPoint> next();

  /// The point of least expected misfit that is not near one that was asked on the common packings: for when those have
  /// all been refuted and the surrogate still expects nothing better than them.
  std::optional<UnitPoint> next_elsewhere();

 private:
  UnitPoint tried_with_coarse_grains(UnitPoint proposal);
  bool imagine_answers(Surrogate& model) const;
  double goal_misfit() const;
  bool was_asked(const UnitPoint& point) const;

  Archive& archive_;
  Objective* coarse_;
  const SearchOptions& options_;
  std::span<const std::uint64_t> common_;
  double goal_;
};

}  // namespace pastefit
