#include "calibrate/inference/combination.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "calibrate/inference/parameter_interval.h"

namespace pastefit {

namespace {

constexpr double difference_step = 0.05;  // of coordinates, for the slopes of the response model, which is smooth
constexpr double visible = 0.3;           // least part of a reading in a combination to be named
constexpr double two_sided = 1.959964;    // standard deviations of 95 %

/// Slope of each fitted reading in each coordinate. Shape: fitted readings x parameters.
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

/// A step along a coordinate as a change of the parameter's value: relative on a logarithmic scale, else in its unit.
double width_of(const Parameter& parameter, double step) {
  if (parameter.scale == Scale::linear) return step * (parameter.upper - parameter.lower);
  return std::expm1(step * std::log(parameter.upper / parameter.lower));
}

}  // namespace

std::vector<Combination> combinations_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                         const UnitPoint& at) {
  const TrainingData& evidence = model.training_data();
  const Eigen::VectorXd before = deviations_before(evidence);
  // The symmetric inverse root of the covariance: each row still belongs to one reading, as far as correlation allows.
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

void heed_sample(Combination& combination, const TrainingData& evidence, const Moments& moments) {
  const auto size = static_cast<Eigen::Index>(combination.direction.size());
  const Eigen::VectorXd direction = Eigen::Map<const Eigen::VectorXd>(combination.direction.data(), size);
  const Eigen::VectorXd before = deviations_before(evidence);
  const Eigen::VectorXd scaled = direction.cwiseQuotient(before);
  const double sampled = std::sqrt(scaled.dot(moments.covariance * scaled));
  if (sampled <= combination.uncertainty && size > 1) return;
  combination.uncertainty = std::min(1.0, sampled);
  combination.lead_width = width_of(evidence.parameters[combination.lead],
                                    two_sided * before[static_cast<Eigen::Index>(combination.lead)] *
                                        combination.uncertainty / combination.direction[combination.lead]);
}

}  // namespace pastefit
