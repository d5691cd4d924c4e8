#include "calibrate/inference/parameter_interval.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

// Width of the outermost part of a range in which the density shows whether the data set an end: share of the range, or
// of the sample's own width if that is less, so that a narrow interval near a bound does not count as ending there.
constexpr double border_of_range = 0.05, border_of_width = 0.25;
constexpr double thin = 0.2;    // density at a bound over the mean density below which the data set the end
constexpr double tail = 0.025;  // share of the sample beyond each end of an interval

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

/// Density of the sample in the outermost part of the range, over that of a uniform distribution.
double density_at(const std::vector<double>& sorted, bool lower_end) {
  const double width = quantile(sorted, 1 - tail) - quantile(sorted, tail);
  const double border = std::clamp(border_of_width * width, 1e-6, border_of_range);
  const auto in_border =
      std::ranges::count_if(sorted, [&](double x) { return lower_end ? x < border : x > 1 - border; });
  return static_cast<double>(in_border) / static_cast<double>(sorted.size()) / border;
}

struct Ends {
  IntervalEnd lower{0, false}, upper{1, false};
};

/// Central 95 % of the sample: 2.5 % beyond each end, also if the other end is the study's bound. Only ends that look
/// sharp count as set by the data, so such ends are too sharp on average: with all 5 % beyond a single end only 88 % of
/// the intervals of fifty twins contained the truth (tests/twins).
Ends ends_of(std::vector<double> coordinates) {
  std::ranges::sort(coordinates);
  Ends ends;
  if (density_at(coordinates, true) < thin) ends.lower = {quantile(coordinates, tail), true};
  if (density_at(coordinates, false) < thin) ends.upper = {quantile(coordinates, 1 - tail), true};
  return ends;
}

/// Extends ends to contain another interval, together with its `known` flags.
void contain(Ends& ends, const Ends& others) {
  if (others.lower.at < ends.lower.at) ends.lower = others.lower;
  if (others.upper.at > ends.upper.at) ends.upper = others.upper;
}

void clip(Ends& ends, const Ends& others) {
  if (others.lower.at > ends.lower.at) ends.lower = others.lower;
  if (others.upper.at < ends.upper.at) ends.upper = others.upper;
}

/// Cell ends for integrating a posterior: uniform, plus the simulated points if it may jump there.
std::vector<double> cell_ends(const ResponseModel& model) {
  constexpr int cells = 400;
  std::vector<double> ends;
  for (int i = 0; i <= cells; ++i) ends.push_back(static_cast<double>(i) / cells);
  if (model.trust().uses_neighbours())
    for (const double coordinate : model.trust().coordinates()) ends.push_back(std::clamp(coordinate, 0.0, 1.0));
  std::ranges::sort(ends);
  return ends;
}

}  // namespace

double deviation_before(const Parameter& parameter) {
  if (!parameter.prior) return 1 / std::sqrt(12.0);
  const UnitPrior prior = unit_prior(parameter);
  constexpr int cells = 1000;
  double sum = 0, mean = 0, square = 0;
  for (int i = 0; i < cells; ++i) {
    const double x = (i + 0.5) / cells;
    const double weight = std::exp(-0.5 * std::pow((x - prior.mean) / prior.deviation, 2));
    sum += weight;
    mean += weight * x;
    square += weight * x * x;
  }
  return std::sqrt(std::max(square / sum - mean * mean / sum / sum, 1e-12));
}

Eigen::VectorXd deviations_before(const TrainingData& evidence) {
  Eigen::VectorXd out(evidence.parameters.size());
  for (std::size_t j = 0; j < evidence.parameters.size(); ++j) out[j] = deviation_before(evidence.parameters[j]);
  return out;
}

std::vector<double> sample_along(const ResponseModel& model, UnitPoint point, Eigen::Index coordinate, int count) {
  const std::vector<double> ends = cell_ends(model);
  std::vector<double> logarithms;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    point[coordinate] = (ends[i - 1] + ends[i]) / 2;
    logarithms.push_back(model.log_posterior(point));
  }
  const double most = *std::ranges::max_element(logarithms);
  std::vector<double> reached{0};
  for (std::size_t i = 1; i < ends.size(); ++i)
    reached.push_back(reached.back() + (ends[i] - ends[i - 1]) * std::exp(logarithms[i - 1] - most));
  std::vector<double> out;
  std::size_t cell = 1;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count * reached.back();
    while (cell + 1 < reached.size() && reached[cell] < share) ++cell;
    const double within = (share - reached[cell - 1]) / std::max(reached[cell] - reached[cell - 1], 1e-300);
    out.push_back(std::lerp(ends[cell - 1], ends[cell], std::clamp(within, 0.0, 1.0)));
  }
  return out;
}

bool ParameterInterval::any_value_fits() const {
  constexpr double near = 0.1;  // of the range
  return unit_of(parameter, fitting_lower) < near && unit_of(parameter, fitting_upper) > 1 - near;
}

ParameterInterval interval_of(const ResponseModel& model, const std::vector<UnitPoint>& sample, const Moments& moments,
                              const UnitPoint& recommended, Eigen::Index coordinate) {
  const Parameter& parameter = model.training_data().parameters[coordinate];
  std::vector<double> coordinates;
  for (const UnitPoint& member : sample) coordinates.push_back(member[coordinate]);
  const double own = recommended[coordinate];
  const Ends around{{own, own > 0}, {own, own < 1}};
  Ends held = ends_of(sample_along(model, recommended, coordinate, static_cast<int>(sample.size())));
  Ends ends = recommended.size() == 1 ? held : ends_of(std::move(coordinates));
  contain(ends, around);
  clip(held, ends);
  contain(held, around);
  const auto in_unit = [&](const IntervalEnd& end) { return IntervalEnd{value_between(parameter, end.at), end.known}; };
  ParameterInterval one;
  one.parameter = parameter;
  one.recommended = value_between(parameter, own);
  one.lower = in_unit(ends.lower);
  one.upper = in_unit(ends.upper);
  one.held_lower = in_unit(held.lower);
  one.held_upper = in_unit(held.upper);
  one.fitting_lower = one.fitting_upper = one.recommended;
  one.deviation_before = deviation_before(parameter);
  one.uncertainty = std::sqrt(moments.covariance(coordinate, coordinate)) / one.deviation_before;
  return one;
}

namespace {

constexpr double difference_step = 0.05;  // of coordinates, for slopes of the smooth response model
constexpr double visible = 0.3;           // least component of a reading in a combination to be named
constexpr double two_sided = 1.959964;    // standard deviations of 95 %

/// Slope of each fitted reading in each coordinate. Shape: fitted readings x parameters.
Eigen::MatrixXd jacobian_of(const ResponseModel& model, const UnitPoint& at) {
  const std::vector<std::size_t>& fitted = model.fitted();
  Eigen::MatrixXd jacobian(fitted.size(), at.size());
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    UnitPoint ahead = at, behind = at;
    ahead[j] = std::min(1.0, at[j] + difference_step);
    behind[j] = std::max(0.0, at[j] - difference_step);
    for (std::size_t k = 0; k < fitted.size(); ++k)
      jacobian(k, j) =
          (model.predict(fitted[k], ahead).mean - model.predict(fitted[k], behind).mean) / (ahead[j] - behind[j]);
  }
  return jacobian;
}

double lead_width_of(const Combination& one, const TrainingData& evidence, const Eigen::VectorXd& before) {
  const Parameter& lead = evidence.parameters[one.lead];
  const double step = two_sided * before[one.lead] * one.uncertainty / one.direction[one.lead];
  if (lead.scale == Scale::linear) return step * (lead.upper - lead.lower);
  return std::expm1(step * std::log(lead.upper / lead.lower));
}

}  // namespace

std::vector<Combination> combinations_of(const ResponseModel& model, const UnitPoint& at) {
  const TrainingData& evidence = model.training_data();
  const std::vector<std::size_t>& fitted = model.fitted();
  const Eigen::VectorXd before = deviations_before(evidence);
  // With the symmetric inverse root of the covariance each row still belongs to one reading, as far as correlation
  // allows.
  const Eigen::MatrixXd in_deviations =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(model.covariance(at)).operatorInverseSqrt();
  const Eigen::MatrixXd scaled = in_deviations * jacobian_of(model, at) * before.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
  std::vector<Combination> combinations;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Combination one;
    if (i < svd.singularValues().size()) one.singular_value = svd.singularValues()[i];
    one.uncertainty = 1 / std::hypot(1, one.singular_value);
    one.direction = svd.matrixV().col(i);
    one.direction.cwiseAbs().maxCoeff(&one.lead);
    if (one.direction[one.lead] < 0) one.direction = -one.direction;
    one.lead_width = lead_width_of(one, evidence, before);
    if (i < svd.matrixU().cols() && i < svd.singularValues().size()) {
      const Eigen::VectorXd part = svd.matrixU().col(i).cwiseAbs();
      std::vector<std::size_t> order(fitted.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t k) { return part[k]; });
      for (const std::size_t k : order)
        if (part[k] >= visible) one.readings.push_back(evidence.readings[fitted[k]].name);
    }
    combinations.push_back(std::move(one));
  }
  return combinations;
}

void heed_sample(Combination& combination, const TrainingData& evidence, const Moments& moments) {
  const Eigen::VectorXd before = deviations_before(evidence);
  const Eigen::VectorXd scaled = combination.direction.cwiseQuotient(before);
  const double sampled = std::sqrt(scaled.dot(moments.covariance * scaled));
  if (sampled <= combination.uncertainty && scaled.size() > 1) return;
  combination.uncertainty = std::min(1.0, sampled);
  combination.lead_width = lead_width_of(combination, evidence, before);
}

}  // namespace pastefit
