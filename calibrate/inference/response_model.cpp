#include "calibrate/inference/response_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibrate/models/replicates.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

constexpr double least_survival = 1e-3;  // a model of failures is too rough to exclude a candidate
constexpr double doubted_heaps = 3;      // further heaps, assumed to show no correlation

/// Sum of the squared differences from the means of the priors, each in standard deviations of its prior.
double distance_from_priors(const TrainingData& evidence, const UnitPoint& point) {
  double squares = 0;
  for (std::size_t j = 0; j < evidence.parameters.size(); ++j) {
    if (!evidence.parameters[j].prior) continue;
    const UnitPrior prior = unit_prior(evidence.parameters[j]);
    squares += std::pow((point[j] - prior.mean) / prior.deviation, 2);
  }
  return squares;
}

}  // namespace

ResponseModel::ResponseModel(TrainingData evidence) : evidence_(std::move(evidence)) {
  if (evidence_.points.empty()) throw std::logic_error("a response model needs a simulation that ended well");
  const Sites known = sites_of(evidence_.points);
  const auto& [places, sites] = known;
  for (std::size_t k = 0; k < evidence_.readings.size(); ++k) {
    const ReadingTrainingData& reading = evidence_.readings[k];
    std::vector<ReadingModel::Answer> answers;
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (const double value = reading.simulated[i]; !std::isnan(value))
        answers.push_back({sites[i], value, reading.bound(i)});
    models_.emplace_back(places, answers);
    if (reading.fitted()) fitted_.push_back(k);
  }
  learn_correlation(sites);
  find_shared();
  count_independent();
  take_conditions();
  learn_rejections();
  trust_.emplace(evidence_, known, models_, fitted_);
  if (evidence_.failed.empty()) return;
  std::vector<UnitPoint> all = evidence_.points;
  all.insert(all.end(), evidence_.failed.begin(), evidence_.failed.end());
  Eigen::VectorXd share = Eigen::VectorXd::Zero(all.size());
  share.tail(evidence_.failed.size()).setOnes();
  failures_.emplace(all, share);
}

void ResponseModel::learn_rejections() {
  std::vector<UnitPoint> points;
  std::vector<double> indices;
  for (std::size_t i = 0; i < evidence_.rejection_indices.size(); ++i) {
    if (std::isnan(evidence_.rejection_indices[i])) continue;
    points.push_back(evidence_.points[i]);
    indices.push_back(evidence_.rejection_indices[i]);
  }
  if (!points.empty()) rejections_.emplace(points, indices);
}

void ResponseModel::learn_correlation(const std::vector<std::size_t>& sites) {
  const auto count = static_cast<Eigen::Index>(fitted_.size());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
  double freedom = 0;
  for (std::size_t site = 0; site < sites.size(); ++site) {  // no more sites than simulations
    Eigen::MatrixXd heaps(count, 0);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (sites[i] != site) continue;
      Eigen::VectorXd heap(count);
      for (Eigen::Index k = 0; k < count; ++k) {
        const ReadingTrainingData& reading = evidence_.readings[fitted_[k]];
        heap[k] = reading.bound(i) ? std::nan("") : reading.simulated[i];
      }
      if (heap.array().isNaN().any()) continue;
      heaps.conservativeResize(Eigen::NoChange, heaps.cols() + 1);
      heaps.rightCols(1) = heap;
    }
    if (heaps.cols() < 2) continue;
    const Eigen::VectorXd mean = heaps.rowwise().mean();
    for (Eigen::Index k = 0; k < count; ++k) {
      const double noise = models_[fitted_[k]].noise_at(mean[k]);
      heaps.row(k).array() -= mean[k];
      if (noise > 0) heaps.row(k) /= noise;
    }
    products += heaps * heaps.transpose();
    freedom += static_cast<double>(heaps.cols() - 1);
  }
  correlation_ = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto first = fitted_[j], second = fitted_[k];
      if (j == k || evidence_.readings[first].test != evidence_.readings[second].test) continue;
      const double size = std::sqrt(products(j, j) * products(k, k));
      correlation_(j, k) = size > 0 ? products(j, k) / size * freedom / (freedom + doubted_heaps) : 0;
    }
}

void ResponseModel::find_shared() {
  shared_.resize(fitted_.size());
  for (std::size_t j = 0; j < fitted_.size(); ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      std::vector<Shared>& shared = shared_[j].emplace_back();
      const double correlation = correlation_(j, k);
      const auto& first = models_[fitted_[j]].rows();
      const auto& second = models_[fitted_[k]].rows();
      for (std::size_t a = 0; a < first.size(); ++a)
        for (std::size_t b = 0; b < second.size(); ++b) {
          if (first[a].site != second[b].site || first[a].is_bound || second[b].is_bound) continue;
          const double both = 1 / std::max(first[a].answers.weight, second[b].answers.weight);
          shared.push_back({a, b, correlation * first[a].noise * second[b].noise * both});
        }
    }
  }
}

void ResponseModel::take_conditions() {
  const auto count = static_cast<Eigen::Index>(fitted_.size());
  of_conditions_ = Eigen::MatrixXd::Zero(count, count);
  for (const ConditionEffect& condition : evidence_.conditions) {
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const ReadingTrainingData& reading = evidence_.readings[fitted_[k]];
      for (const ConditionEffect::Reading& one : condition.readings)
        if (one.name == reading.name) moved[k] = (one.at_upper - one.at_lower) / std::sqrt(reading.weight);
    }
    of_conditions_ += moved * moved.transpose() / 12;
  }
}

void ResponseModel::count_independent() {
  const auto count = static_cast<Eigen::Index>(fitted_.size());
  Eigen::MatrixXd all(count, 0);
  for (Eigen::Index i = 0; i < std::ssize(evidence_.points); ++i) {
    Eigen::VectorXd one(count);
    for (Eigen::Index k = 0; k < count; ++k) one[k] = evidence_.readings[fitted_[k]].simulated[i];
    if (one.array().isNaN().any()) continue;
    all.conservativeResize(Eigen::NoChange, all.cols() + 1);
    all.rightCols(1) = one;
  }
  if (all.cols() < 2) return;
  all.colwise() -= all.rowwise().mean().eval();
  const Eigen::VectorXd sizes = all.rowwise().norm();
  for (Eigen::Index k = 0; k < count; ++k)
    if (sizes[k] > 0) all.row(k) /= sizes[k];
  // A constant reading counts as independent of the others.
  Eigen::MatrixXd correlation = all * all.transpose();
  correlation.diagonal().setOnes();
  independent_ = static_cast<double>(count) / correlation.squaredNorm();
}

ReadingModel::Prediction ResponseModel::predict(std::size_t reading, const UnitPoint& point) const {
  return models_.at(reading).predict(point);
}

std::optional<ReadingModel::Prediction> ResponseModel::change(std::size_t reading, const UnitPoint& from,
                                                              const UnitPoint& to) const {
  if (!trust_->predicts(from) || !trust_->predicts(to)) return std::nullopt;
  return models_.at(reading).change(from, to);
}

double ResponseModel::expected(std::size_t reading, const UnitPoint& point) const {
  if (!trust_->predicts(point)) {
    Replicates answers;
    const Eigen::VectorXd& simulated = evidence_.readings.at(reading).simulated;
    for (std::size_t i = 0; i < evidence_.points.size(); ++i)
      if (const double value = simulated[i]; evidence_.points[i] == point && !std::isnan(value)) answers.add(value);
    if (answers.weight > 0) return answers.mean;
  }
  return predict(reading, point).mean;
}

bool ResponseModel::is_known(const UnitPoint& point) const {
  return trust_->predicts(point) || std::ranges::find(evidence_.points, point) != evidence_.points.end();
}

double ResponseModel::noise(std::size_t reading, const UnitPoint& point) const {
  return models_.at(reading).noise_at(predict(reading, point).mean);
}

std::vector<ReadingModel::Prediction> ResponseModel::predictions(const UnitPoint& point) const {
  std::vector<ReadingModel::Prediction> out;
  for (const std::size_t k : fitted_) out.push_back(models_[k].predict(point));
  return out;
}

Eigen::MatrixXd ResponseModel::covariance(const UnitPoint& point) const {
  const auto known = predictions(point);
  return errors_of_laboratory(known) + predictive_variance(known);
}

Eigen::MatrixXd ResponseModel::errors_of_laboratory(const std::vector<ReadingModel::Prediction>& predictions) const {
  Eigen::MatrixXd out(fitted_.size(), fitted_.size());
  std::vector<double> of_heap;  // part of the standard deviation of a measurement due to replicate scatter
  for (std::size_t j = 0; j < fitted_.size(); ++j) {
    const ReadingTrainingData& first = evidence_.readings[fitted_[j]];
    out(j, j) = first.variance();
    of_heap.push_back(std::min(models_[fitted_[j]].noise_at(predictions[j].mean), first.widening * first.deviation) /
                      std::sqrt(first.weight));
    for (std::size_t k = 0; k < j; ++k) {
      const ReadingTrainingData& second = evidence_.readings[fitted_[k]];
      out(j, k) = out(k, j) = correlation_(j, k) * of_heap[j] * of_heap[k] / std::max(first.repeats, second.repeats);
    }
  }
  return out + of_conditions_;
}

Eigen::MatrixXd ResponseModel::predictive_variance(const std::vector<ReadingModel::Prediction>& predictions) const {
  Eigen::MatrixXd out(fitted_.size(), fitted_.size());
  for (std::size_t j = 0; j < fitted_.size(); ++j) {
    out(j, j) = predictions[j].variance;
    for (std::size_t k = 0; k < j; ++k) {
      double both = 0;
      for (const Shared& one : shared_[j][k])
        both += predictions[j].weights[one.row_of_first] * predictions[k].weights[one.row_of_second] * one.covariance;
      out(j, k) = out(k, j) = both;
    }
  }
  return out;
}

double ResponseModel::distance(const UnitPoint& point) const {
  double squares = 0;
  for (const std::size_t k : fitted_) {
    const ReadingTrainingData& reading = evidence_.readings[k];
    squares += reading.weight * std::pow((expected(k, point) - *reading.measured) / reading.deviation, 2);
  }
  return std::sqrt(squares + distance_from_priors(evidence_, point));
}

double ResponseModel::log_posterior(const UnitPoint& point) const {
  return log_likelihood(point) - 0.5 * distance_from_priors(evidence_, point);
}

double ResponseModel::log_likelihood(const UnitPoint& point) const {
  if (trust_->uses_neighbours()) return trust_->log_likelihood(point[0]);
  const std::vector<ReadingModel::Prediction> known = predictions(point);
  Eigen::VectorXd differences(std::ssize(known));
  for (std::size_t k = 0; k < known.size(); ++k)
    differences[k] = known[k].mean - *evidence_.readings[fitted_[k]].measured;
  const Eigen::MatrixXd laboratory = errors_of_laboratory(known);
  const Eigen::LLT<Eigen::MatrixXd> of_laboratory(laboratory), of_both(laboratory + predictive_variance(known));
  const auto half_log_determinant = [](const Eigen::LLT<Eigen::MatrixXd>& cholesky) {
    return Eigen::MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
  };
  const double by_laboratory = half_log_determinant(of_laboratory);
  // With one parameter, the readings of neighbouring simulations limit the likelihood where the predictive variance is
  // large.
  const double met =
      std::min(-0.5 * of_both.matrixL().solve(differences).squaredNorm(), trust_->log_likelihood(point[0]));
  double sum = met - by_laboratory - independent_ * (half_log_determinant(of_both) - by_laboratory);
  if (rejections_) sum += evidence_.accepted_heaps * std::log1p(-rejections_->probability(point));
  if (failures_) sum += std::log(std::clamp(1 - failures_->predict(point).mean, least_survival, 1.0));
  return sum;
}

}  // namespace pastefit
