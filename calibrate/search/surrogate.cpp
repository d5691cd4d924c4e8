#include "calibrate/search/surrogate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/search/nlopt_search.h"

namespace pastefit {
namespace {

/// Any packing will do where none is simulated.
const std::vector<std::uint64_t> no_packing{0};

}  // namespace

Surrogate::Surrogate(std::span<const Response> seen) : parameters_(static_cast<int>(seen.front().point.size())) {
  std::vector<UnitPoint> all;
  std::vector<const Response*> feasible;
  Eigen::VectorXd failed(static_cast<Eigen::Index>(seen.size()));
  for (const Response& response : seen) {
    failed[static_cast<Eigen::Index>(all.size())] = is_feasible(response) ? 0 : 1;
    all.push_back(response.point);
    if (!is_feasible(response)) continue;
    feasible.push_back(&response);
    worst_ = std::max(worst_, response.misfit);
  }
  for (Eigen::Index k = 0; k < feasible.front()->residuals.size(); ++k) {
    std::vector<UnitPoint> points;
    std::vector<double> values;
    for (const Response* response : feasible) {
      if (!has_reading(*response, k)) continue;
      points.push_back(response->point);
      values.push_back(response->residuals[k]);
    }
    models_.emplace_back();
    if (points.empty()) continue;
    models_.back().emplace(points, Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)));
  }
  if (failed.sum() > 0) failures_ = std::make_unique<GaussianProcess>(all, failed);
}

std::vector<Response> Surrogate::evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t>) {
  std::vector<Response> responses;
  for (const UnitPoint& point : points) {
    Response response;
    response.point = point;
    response.residuals.resize(residuals());
    double variance = 0;
    for (std::size_t k = 0; k < models_.size(); ++k) {
      const auto prediction = models_[k] ? models_[k]->predict(point) : GaussianProcess::Prediction{};
      response.residuals[static_cast<Eigen::Index>(k)] = prediction.mean;
      variance += prediction.variance;
    }
    const double failing = failures_ ? std::clamp(failures_->predict(point).mean, 0.0, 1.0) : 0;
    response.misfit = 0.5 * (response.residuals.squaredNorm() + variance) + failing * worst_;
    responses.push_back(std::move(response));
  }
  return responses;
}

Eigen::VectorXd Surrogate::imagine(const UnitPoint& point, int packings, const Eigen::VectorXd& luck) {
  Eigen::VectorXd answer(residuals());
  for (std::size_t k = 0; k < models_.size(); ++k) {
    const auto place = static_cast<Eigen::Index>(k);
    answer[place] = 0;
    if (!models_[k]) continue;
    const GaussianProcess::Prediction prediction = models_[k]->predict(point);
    answer[place] = prediction.mean + luck[place] * std::sqrt(prediction.variance);
    models_[k]->imagine(point, answer[place], packings);
  }
  return answer;
}

int Surrogate::budget_left() const {
  return std::numeric_limits<int>::max();
}

double Surrogate::noise() const {
  double variance = 0;
  for (const auto& model : models_) variance += model ? model->noise_variance() : 0;
  return 0.5 * variance;
}

UnitPoint least_point(Objective& model, const UnitPoint& start) {
  NloptOptions options;
  options.algorithm = "direct_l";
  options.evaluations = 150 * model.parameters();
  const UnitPoint rough = search_nlopt(model, no_packing, start, options).best.point;
  options.algorithm = "bobyqa";
  options.initial_step = 0.1;
  return search_nlopt(model, no_packing, rough, options).best.point;
}

}  // namespace pastefit
