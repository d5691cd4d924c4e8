#include "calibrate/inference/inference.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

constexpr double neighbourhood = 0.2;   // distance in the unit cube below which two materials count as one
constexpr std::size_t family_size = 5;  // the recommended material included

/// Adds points as far as possible from each other and from those chosen, until there are `count`, or all others are
/// nearer than `apart` to a chosen one.
void spread_out(std::vector<UnitPoint>& chosen, const std::vector<UnitPoint>& points, std::size_t count,
                double apart = 0) {
  while (chosen.size() < count) {
    const UnitPoint* farthest = nullptr;
    double most = apart;
    for (const UnitPoint& point : points) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const UnitPoint& other : chosen) nearest = std::min(nearest, (point - other).norm());
      if (nearest <= most) continue;
      most = nearest;
      farthest = &point;
    }
    if (!farthest) return;
    chosen.push_back(*farthest);
  }
}

/// The half of the points with the smaller distances.
std::vector<UnitPoint> better_half(const ResponseModel& model, const std::vector<UnitPoint>& points) {
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t i = 0; i < points.size(); ++i) by_distance.emplace_back(model.distance(points[i]), i);
  std::ranges::sort(by_distance);
  std::vector<UnitPoint> half;
  for (std::size_t i = 0; i < (points.size() + 1) / 2; ++i) half.push_back(points[by_distance[i].second]);
  return half;
}

/// Points at which every fitted reading is expected within one standard deviation of the measurement, or as near to it
/// as at the recommended point. Excludes points where the response jumps, unless they were simulated.
std::vector<UnitPoint> fitting(const ResponseModel& model, const std::vector<UnitPoint>& points,
                               const UnitPoint& recommended) {
  const auto error = [&](std::size_t k, const UnitPoint& point) {
    const ReadingTrainingData& reading = model.training_data().readings[k];
    return std::abs(model.expected(k, point) - *reading.measured) / reading.deviation;
  };
  const double as_well = std::max(1.0, model.distance(recommended));  // priors included
  std::vector<UnitPoint> out;
  std::ranges::copy_if(points, std::back_inserter(out), [&](const UnitPoint& point) {
    return model.is_known(point) && model.distance(point) <= as_well &&
           std::ranges::all_of(model.fitted(),
                               [&](std::size_t k) { return error(k, point) <= std::max(1.0, error(k, recommended)); });
  });
  return out;
}

/// Recommended candidate, then simulated ones that fit, then predicted ones; all within the intervals.
std::vector<EquivalentMaterial> family_of(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                          const UnitPoint& recommended,
                                          const std::vector<ParameterInterval>& intervals) {
  const TrainingData& evidence = model.training_data();
  const auto value = [&](const UnitPoint& point, std::size_t j) {
    return value_between(evidence.parameters[j], point[j]);
  };
  const auto chosen_from = [&](const std::vector<UnitPoint>& candidates) {
    std::vector<UnitPoint> chosen = fitting(model, candidates, recommended);
    std::erase_if(chosen, [&](const UnitPoint& point) {
      for (std::size_t j = 0; j < intervals.size(); ++j)
        if (value(point, j) < intervals[j].lower.at || value(point, j) > intervals[j].upper.at) return true;
      return false;
    });
    return chosen;
  };
  std::vector<UnitPoint> points{recommended};
  spread_out(points, chosen_from(evidence.points), family_size, neighbourhood);
  spread_out(points, chosen_from(better_half(model, sample)), family_size);
  std::vector<EquivalentMaterial> family;
  for (const UnitPoint& point : points) {
    EquivalentMaterial member;
    member.point = point;
    for (std::size_t j = 0; j < evidence.parameters.size(); ++j) member.values.push_back(value(point, j));
    for (const std::size_t k : model.fitted()) member.readings.push_back(model.expected(k, point));
    member.simulated = std::ranges::find(evidence.points, point) != evidence.points.end();
    member.distance = model.distance(point);
    family.push_back(std::move(member));
  }
  return family;
}

std::vector<UnitPoint> sample_posterior(const ResponseModel& model, const InferenceOptions& options) {
  if (model.training_data().parameters.size() == 1) {
    std::vector<UnitPoint> line;
    for (const double x : sample_along(model, UnitPoint::Constant(1, 0.5), 0, options.sample))
      line.push_back(UnitPoint::Constant(1, x));
    return line;
  }
  return posterior_sample([&](const UnitPoint& point) { return model.log_posterior(point); },
                          static_cast<int>(model.training_data().parameters.size()), options.sample, options.seed);
}

/// Ends of the range of a single parameter that may fit and were not simulated; the model extrapolates poorly beyond
/// the outermost simulation.
std::vector<UnitPoint> open_ends(const TrainingData& evidence, const std::vector<UnitPoint>& sample) {
  constexpr double near = 0.1;
  std::vector<UnitPoint> out;
  if (evidence.parameters.size() != 1) return out;
  for (const double end : {0.0, 1.0}) {
    const bool open = std::ranges::any_of(sample, [&](const UnitPoint& one) { return std::abs(one[0] - end) < near; });
    UnitPoint point = UnitPoint::Constant(1, end);
    if (open && std::ranges::find(evidence.points, point) == evidence.points.end()) out.push_back(std::move(point));
  }
  return out;
}

/// Extends the fitting range of each parameter to a material that fits.
void widen_by(std::vector<ParameterInterval>& intervals, const TrainingData& evidence, const UnitPoint& point) {
  for (std::size_t j = 0; j < intervals.size(); ++j) {
    const double value = value_between(evidence.parameters[j], point[j]);
    intervals[j].fitting_lower = std::min(intervals[j].fitting_lower, value);
    intervals[j].fitting_upper = std::max(intervals[j].fitting_upper, value);
  }
}

std::vector<std::vector<double>> correlation_of(const Moments& moments) {
  std::vector<std::vector<double>> out;
  const Eigen::MatrixXd& covariance = moments.covariance;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    std::vector<double>& row = out.emplace_back();
    for (Eigen::Index j = 0; j < covariance.cols(); ++j)
      row.push_back(covariance(i, j) / std::sqrt(std::max(1e-300, covariance(i, i) * covariance(j, j))));
  }
  return out;
}

}  // namespace

std::vector<UnitPoint> candidates_to_examine(const TrainingData& evidence, const UnitPoint& recommended, int count,
                                             const InferenceOptions& options) {
  const ResponseModel model(evidence);
  const std::vector<UnitPoint> sample = sample_posterior(model, options);
  std::vector<UnitPoint> chosen{recommended};
  for (UnitPoint& end : open_ends(evidence, sample))
    if (std::ssize(chosen) <= count) chosen.push_back(std::move(end));
  spread_out(chosen, better_half(model, sample), static_cast<std::size_t>(count) + 1);
  chosen.erase(chosen.begin());
  return chosen;
}

Inference infer(const TrainingData& evidence, const UnitPoint& recommended, const InferenceOptions& options) {
  const ResponseModel model(evidence);
  const std::vector<std::size_t>& fitted = model.fitted();
  if (fitted.empty()) throw std::logic_error("infer: no reading is fitted");
  const std::vector<UnitPoint> sample = sample_posterior(model, options);
  const Moments moments = moments_of(sample);

  Inference out;
  out.simulations = static_cast<int>(evidence.points.size() + evidence.failed.size());
  for (const std::size_t k : fitted) {
    out.fitted.push_back(evidence.readings[k].name);
    out.noise.push_back(model.noise(k, recommended));
  }
  out.combinations = combinations_of(model, recommended);
  for (Eigen::Index j = 0; j < recommended.size(); ++j)
    out.intervals.push_back(interval_of(model, sample, moments, recommended, j));
  std::vector<UnitPoint> seen = sample;
  seen.insert(seen.end(), evidence.points.begin(), evidence.points.end());
  for (const UnitPoint& point : fitting(model, seen, recommended)) widen_by(out.intervals, evidence, point);
  out.jumps = !model.trust().predicts(recommended);
  for (Combination& combination : out.combinations) heed_sample(combination, evidence, moments);
  out.correlation = correlation_of(moments);
  out.conditions = evidence.conditions;
  out.family = family_of(model, sample, recommended, out.intervals);
  if (!out.jumps) out.gains = measurement_gains(model, sample, moments, recommended);
  return out;
}

}  // namespace pastefit
