#include "calibrate/search/prospects.h"

#include <algorithm>
#include <limits>

#include "calibrate/search/response.h"

namespace pastefit {
namespace {

constexpr double far_from_prior = 2;  // standard deviations at which a candidate contradicts what is known
constexpr double no_misfit = std::numeric_limits<double>::infinity();  // larger than any

}  // namespace

Prospects::Prospects(const Archive& archive, std::span<const UnitPoint> refuted)
    : archive_(archive),
      surrogate_(archive.evidence(), archive.allowances()),
      misfit_of_best_(no_misfit),
      least_misfit_(no_misfit) {
  const auto is_refuted = [&](const UnitPoint& point) {
    return std::ranges::any_of(refuted, [&](const UnitPoint& one) { return one == point; });
  };
  for (const Response& seen : archive.evidence()) {
    if (!is_feasible(seen)) continue;
    const double misfit = surrogate_.outlook(seen.point).mean();
    if (misfit >= least_misfit_) continue;
    least_misfit_ = misfit;
    least_ = seen.point;
  }
  for (const Response& seen : archive.singles()) {
    if (!is_whole(seen) || is_refuted(seen.point)) continue;
    const double misfit = surrogate_.outlook(seen.point).mean();
    if (misfit >= misfit_of_best_) continue;
    misfit_of_best_ = misfit;
    best_ = seen.point;
  }
}

double Prospects::chance_of(const UnitPoint& point, double tolerances) const {
  Eigen::VectorXd bounds = Eigen::VectorXd::Constant(archive_.residuals(), far_from_prior);
  for (int k = 0; k < archive_.readings(); ++k)
    bounds[k] = tolerances * archive_.allowance(static_cast<std::size_t>(k));
  return surrogate_.within(bounds, point);
}

}  // namespace pastefit
