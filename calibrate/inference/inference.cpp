#include "calibrate/inference/inference.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

constexpr double difference_step = 0.05;  // of the response model, which is smooth
constexpr double border = 0.05;           // of a range: where the sample shows whether the data set an end
constexpr double thin = 0.2;              // density at a bound, over the mean one, below
                                          // which the data set the end
constexpr double tail = 0.025;            // of the sample beyond each end of an interval
constexpr double visible = 0.3;           // part of a reading in a combination worth a word
constexpr double neighbourhood = 0.2;     // of the cube: materials nearer than this are one to a person
constexpr double two_sided = 1.959964;    // standard deviations of 95 %

/// Standard deviation of a coordinate before the test: evenly spread over the bounds, or of the prior between them.
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
  Eigen::VectorXd out(static_cast<Eigen::Index>(evidence.parameters.size()));
  for (std::size_t j = 0; j < evidence.parameters.size(); ++j)
    out[static_cast<Eigen::Index>(j)] = deviation_before(evidence.parameters[j]);
  return out;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

/// Share of the sample in the outermost part of the range, over the share an
/// even spread has there.
double density_at(const std::vector<double>& sorted, bool lower_end) {
  const auto in_border =
      std::ranges::count_if(sorted, [&](double x) { return lower_end ? x < border : x > 1 - border; });
  return static_cast<double>(in_border) / static_cast<double>(sorted.size()) / border;
}

struct Ends {
  double lower = 0, upper = 1;
  bool lower_known = false, upper_known = false;
};

/// 95 % of the sample, the same share beyond either end; also where the data leave the other end to the bound. The data
/// choose the ends they set, and an end that was chosen because it looked sharp is sharper than it should be: with
/// all 5 % beyond a single end 88 % of the intervals of fifty twins held the truth (tests/twins).
Ends ends_of(std::vector<double> coordinates) {
  std::ranges::sort(coordinates);
  Ends ends;
  ends.lower_known = density_at(coordinates, true) < thin;
  ends.upper_known = density_at(coordinates, false) < thin;
  if (ends.lower_known) ends.lower = quantile(coordinates, tail);
  if (ends.upper_known) ends.upper = quantile(coordinates, 1 - tail);
  return ends;
}

/// 95 % of the posterior along one coordinate, the others held: the part
/// between its tails.
std::pair<double, double> held_ends(const ResponseModel& model, UnitPoint point, Eigen::Index coordinate) {
  constexpr int cells = 400;
  std::vector<double> logarithms;
  for (int i = 0; i < cells; ++i) {
    point[coordinate] = (i + 0.5) / cells;
    logarithms.push_back(model.log_posterior(point));
  }
  const double most = *std::ranges::max_element(logarithms);
  double sum = 0;
  for (double& value : logarithms) sum += value = std::exp(value - most);
  std::pair<double, double> ends{0, 1};
  double reached = 0;
  for (int i = 0; i < cells; ++i) {
    const double after = reached + logarithms[static_cast<std::size_t>(i)] / sum;
    if (reached < tail && after >= tail) ends.first = static_cast<double>(i) / cells;
    if (reached < 1 - tail && after >= 1 - tail) ends.second = static_cast<double>(i + 1) / cells;
    reached = after;
  }
  return ends;
}

/// Change of each fitted reading with each coordinate. Shape: fitted readings x
/// parameters.
Eigen::MatrixXd jacobian_of(const ResponseModel& model, const std::vector<std::size_t>& fitted, const UnitPoint& at) {
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(fitted.size()), at.size());
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    UnitPoint ahead = at, behind = at;
    ahead[j] = std::min(1.0, at[j] + difference_step);
    behind[j] = std::max(0.0, at[j] - difference_step);
    for (std::size_t k = 0; k < fitted.size(); ++k)
      jacobian(static_cast<Eigen::Index>(k), j) =
          (model.predict(fitted[k], ahead).mean - model.predict(fitted[k], behind).mean) / (ahead[j] - behind[j]);
  }
  return jacobian;
}

/// A step along a coordinate as a change of the parameter's value: a share of
/// it if logarithmic, else in its unit.
double width_of(const Parameter& parameter, double step) {
  if (parameter.scale == Scale::linear) return step * (parameter.upper - parameter.lower);
  return std::expm1(step * std::log(parameter.upper / parameter.lower));
}

std::vector<Combination> combinations_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                         const UnitPoint& at) {
  const TrainingData& evidence = model.training_data();
  const Eigen::VectorXd before = deviations_before(evidence);
  // The symmetric root: each row stays the one of its reading, as far as the readings are told apart.
  const Eigen::MatrixXd in_deviations =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(model.covariance(at)).operatorInverseSqrt();
  const Eigen::MatrixXd scaled = in_deviations * jacobian_of(model, fitted, at) * before.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
  std::vector<Combination> combinations;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Combination one;
    if (i < svd.singularValues().size()) one.singular_value = svd.singularValues()[i];
    one.uncertainty = 1 / std::hypot(1, one.singular_value);
    Eigen::VectorXd direction = svd.matrixV().col(i);
    Eigen::Index lead = 0;
    direction.cwiseAbs().maxCoeff(&lead);
    if (direction[lead] < 0) direction = -direction;
    one.direction.assign(direction.begin(), direction.end());
    one.lead = static_cast<std::size_t>(lead);
    one.lead_width =
        width_of(evidence.parameters[one.lead], two_sided * before[lead] * one.uncertainty / direction[lead]);
    if (i < svd.matrixU().cols() && i < svd.singularValues().size()) {
      const Eigen::VectorXd part = svd.matrixU().col(i).cwiseAbs();
      std::vector<std::size_t> order(fitted.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::stable_sort(order, std::ranges::greater{},
                               [&](std::size_t k) { return part[static_cast<Eigen::Index>(k)]; });
      for (const std::size_t k : order)
        if (part[static_cast<Eigen::Index>(k)] >= visible) one.readings.push_back(evidence.readings[fitted[k]].name);
    }
    combinations.push_back(std::move(one));
  }
  return combinations;
}

/// Chooses points as far from each other, and from those chosen already, as can be; stops at `count` in all, or when
/// what is left lies nearer than `apart` to one that was chosen.
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

/// The half of the points that misses the laboratory least.
std::vector<UnitPoint> better_half(const ResponseModel& model, const std::vector<UnitPoint>& points) {
  std::vector<std::pair<double, std::size_t>> by_miss;
  for (std::size_t i = 0; i < points.size(); ++i) by_miss.emplace_back(model.normalised_error(points[i]), i);
  std::ranges::sort(by_miss);
  std::vector<UnitPoint> half;
  for (std::size_t i = 0; i < (points.size() + 1) / 2; ++i) half.push_back(points[by_miss[i].second]);
  return half;
}

/// The recommended candidate, then simulated ones of which every fitted reading is within the laboratory's deviation,
/// or as near as the recommended one's, then ones of which that is predicted.
std::vector<EquivalentMaterial> family_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                          const std::vector<UnitPoint>& sample, const UnitPoint& recommended,
                                          int count) {
  const TrainingData& evidence = model.training_data();
  const auto error = [&](std::size_t k, const UnitPoint& point) {
    const ReadingEvidence& reading = evidence.readings[k];
    return std::abs(model.predict(k, point).mean - *reading.measured) / reading.deviation;
  };
  const double as_well = std::max(1.0, model.normalised_error(recommended));  // priors included
  const auto fits = [&](const UnitPoint& point) {
    return model.normalised_error(point) <= as_well && std::ranges::all_of(fitted, [&](std::size_t k) {
             return error(k, point) <= std::max(1.0, error(k, recommended));
           });
  };
  const auto fitting = [&](const std::vector<UnitPoint>& candidates) {
    std::vector<UnitPoint> chosen;
    std::ranges::copy_if(candidates, std::back_inserter(chosen), fits);
    return chosen;
  };
  const auto size = static_cast<std::size_t>(count);
  std::vector<UnitPoint> points{recommended};
  spread_out(points, fitting(evidence.points), size, neighbourhood);
  spread_out(points, fitting(better_half(model, sample)), size);
  std::vector<EquivalentMaterial> family;
  for (const UnitPoint& point : points) {
    EquivalentMaterial member;
    member.point = point;
    for (Eigen::Index j = 0; j < point.size(); ++j)
      member.values.push_back(value_between(evidence.parameters[static_cast<std::size_t>(j)], point[j]));
    for (const std::size_t k : fitted) member.readings.push_back(model.predict(k, point).mean);
    member.simulated = std::ranges::find(evidence.points, point) != evidence.points.end();
    member.normalised_error = model.normalised_error(point);
    family.push_back(std::move(member));
  }
  return family;
}

std::vector<UnitPoint> sample_posterior(const ResponseModel& model, const InferenceOptions& options) {
  return posterior_sample([&](const UnitPoint& point) { return model.log_posterior(point); },
                          static_cast<int>(model.training_data().parameters.size()), options.sample, options.seed);
}

struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Moments moments_of(const std::vector<UnitPoint>& sample) {
  const auto dimension = sample.front().size();
  const auto count = static_cast<double>(sample.size());
  Moments out{Eigen::VectorXd::Zero(dimension), Eigen::MatrixXd::Zero(dimension, dimension)};
  for (const UnitPoint& member : sample) out.mean += member / count;
  for (const UnitPoint& member : sample)
    out.covariance += (member - out.mean) * (member - out.mean).transpose() / (count - 1);
  return out;
}

/// A reading a laboratory may be advised to take, by the name of the simulation's reading; with the name of its test
/// before a slash where a study has several.
bool measurable(const std::string& name) {
  const std::string own = name.substr(name.find('/') + 1);
  const auto kinds = all_reading_kinds();
  const ReadingKind* kind = find_kind(kinds, own);
  return kind && kind->advised;
}

/// Whether the model meets a reading at all; one that it misses by far would mislead it, however often it is taken.
bool met(const ResponseModel& model, std::size_t reading, const UnitPoint& recommended) {
  const ReadingEvidence& evidence = model.training_data().readings[reading];
  if (!evidence.measured) return true;
  const auto prediction = model.predict(reading, recommended);
  return std::abs(prediction.mean - *evidence.measured) <=
         3 * std::hypot(evidence.deviation, std::sqrt(prediction.variance));
}

/// What further measurements of one reading would leave of each coordinate's
/// standard deviation, to first order in the sample: 1 - cov(x, m)^2/(var x
/// (var m + error)), m the mean reading of a member.
MeasurementGain gain_of(const ResponseModel& model, std::size_t reading, const std::vector<UnitPoint>& sample,
                        const Moments& moments, std::size_t lead, int repeats, double typical_deviation) {
  const ReadingEvidence& evidence = model.training_data().readings[reading];
  MeasurementGain gain;
  gain.reading = evidence.name;
  gain.measurements = repeats;
  gain.deviation = evidence.measured ? evidence.deviation : typical_deviation;
  const auto count = static_cast<double>(sample.size());
  Eigen::VectorXd means(static_cast<Eigen::Index>(sample.size()));
  double predictive_variance = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const auto prediction = model.predict(reading, sample[i]);
    means[static_cast<Eigen::Index>(i)] = prediction.mean;
    predictive_variance += prediction.variance / count;
  }
  const Eigen::VectorXd deviations = means.array() - means.mean();
  const double error = gain.deviation * gain.deviation / repeats + predictive_variance;
  const double variance = deviations.squaredNorm() / (count - 1);
  for (Eigen::Index j = 0; j < moments.mean.size(); ++j) {
    double covariance = 0;
    for (std::size_t i = 0; i < sample.size(); ++i)
      covariance += deviations[static_cast<Eigen::Index>(i)] * (sample[i][j] - moments.mean[j]) / (count - 1);
    const double own = std::max(moments.covariance(j, j), 1e-12);
    const double left = std::sqrt(std::max(0.0, 1 - covariance * covariance / (own * (variance + error))));
    if (static_cast<std::size_t>(j) == lead) gain.lead_narrowing = left;
    if (left >= gain.narrowing) continue;
    gain.narrowing = left;
    gain.parameter = model.training_data().parameters[static_cast<std::size_t>(j)].name;
  }
  return gain;
}

/// Slopes at one point promise too much where the valley bends; the sample's own width along the combination counts.
void heed_sample(Combination& combination, const TrainingData& evidence, const Moments& moments) {
  const auto size = static_cast<Eigen::Index>(combination.direction.size());
  const Eigen::VectorXd direction = Eigen::Map<const Eigen::VectorXd>(combination.direction.data(), size);
  const Eigen::VectorXd before = deviations_before(evidence);
  const Eigen::VectorXd scaled = direction.cwiseQuotient(before);
  const double sampled = std::sqrt(scaled.dot(moments.covariance * scaled));
  if (sampled <= combination.uncertainty) return;
  combination.uncertainty = std::min(1.0, sampled);
  combination.lead_width = width_of(evidence.parameters[combination.lead],
                                    two_sided * before[static_cast<Eigen::Index>(combination.lead)] *
                                        combination.uncertainty / combination.direction[combination.lead]);
}

}  // namespace

std::vector<UnitPoint> candidates_to_examine(const TrainingData& evidence, const UnitPoint& recommended, int count,
                                             const InferenceOptions& options) {
  const ResponseModel model(evidence);
  std::vector<UnitPoint> chosen{recommended};
  spread_out(chosen, better_half(model, sample_posterior(model, options)), static_cast<std::size_t>(count) + 1);
  chosen.erase(chosen.begin());
  return chosen;
}

Inference infer(const TrainingData& evidence, const UnitPoint& recommended, const InferenceOptions& options) {
  const ResponseModel model(evidence);
  const std::vector<std::size_t>& fitted = model.fitted();
  if (fitted.empty()) throw std::logic_error("infer: no reading is fitted");
  const auto dimension = recommended.size();
  const std::vector<UnitPoint> sample = sample_posterior(model, options);
  const Moments moments = moments_of(sample);

  Inference out;
  out.simulations = static_cast<int>(evidence.points.size() + evidence.failed.size());
  double typical_deviation = std::numeric_limits<double>::infinity();
  for (const std::size_t k : fitted) {
    out.fitted.push_back(evidence.readings[k].name);
    out.noise.push_back(model.noise(k, recommended));
    typical_deviation = std::min(typical_deviation, evidence.readings[k].deviation);
  }
  out.combinations = combinations_of(model, fitted, recommended);

  double linear_gap = 0;
  for (Eigen::Index j = 0; j < dimension; ++j) {
    const Parameter& parameter = evidence.parameters[static_cast<std::size_t>(j)];
    std::vector<double> coordinates;
    for (const UnitPoint& member : sample) coordinates.push_back(member[j]);
    const Ends ends = ends_of(std::move(coordinates));
    const auto [held_lower, held_upper] = held_ends(model, recommended, j);
    ParameterInterval one;
    one.name = parameter.name;
    one.scale = parameter.scale;
    one.bound_lower = parameter.lower;
    one.bound_upper = parameter.upper;
    one.recommended = value_between(parameter, recommended[j]);
    one.lower = value_between(parameter, ends.lower);
    one.upper = value_between(parameter, ends.upper);
    one.lower_known = ends.lower_known;
    one.upper_known = ends.upper_known;
    one.held_lower = value_between(parameter, held_lower);
    one.held_upper = value_between(parameter, held_upper);
    one.prior = parameter.prior;
    one.deviation_before = deviation_before(parameter);
    one.uncertainty = std::sqrt(moments.covariance(j, j)) / one.deviation_before;
    double linear = 0;
    for (const Combination& combination : out.combinations)
      linear += std::pow(combination.direction[static_cast<std::size_t>(j)] * combination.uncertainty, 2);
    linear_gap = std::max(linear_gap, std::abs(std::sqrt(linear) - one.uncertainty));
    out.intervals.push_back(std::move(one));
  }
  out.linear = linear_gap <= 0.2;
  for (Combination& combination : out.combinations) heed_sample(combination, evidence, moments);

  for (Eigen::Index i = 0; i < dimension; ++i) {
    std::vector<double> row;
    for (Eigen::Index j = 0; j < dimension; ++j)
      row.push_back(moments.covariance(i, j) /
                    std::sqrt(std::max(1e-300, moments.covariance(i, i) * moments.covariance(j, j))));
    out.correlation.push_back(std::move(row));
  }

  out.conditions = evidence.conditions;
  out.family = family_of(model, fitted, sample, recommended, options.family);

  for (std::size_t k = 0; k < evidence.readings.size(); ++k)
    if (measurable(evidence.readings[k].name) && met(model, k, recommended))
      out.gains.push_back(
          gain_of(model, k, sample, moments, out.combinations.front().lead, options.repeats, typical_deviation));
  std::ranges::stable_sort(out.gains, {}, &MeasurementGain::narrowing);
  return out;
}

}  // namespace pastefit
