#include "calibrate/batch/trend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/models/gaussian_process.h"

namespace pastefit {

namespace {

constexpr double kNormal = 1.96;  // standard deviations of a 95 % interval

TrendPrediction predict_line(std::span<const double> x, std::span<const double> y, double at) {
  const double n = static_cast<double>(x.size());
  const double mean_x = sample_of(x).mean, mean_y = sample_of(y).mean;
  double xx = 0, xy = 0, squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - mean_y - slope * (x[i] - mean_x);
    squares += residual * residual;
  }
  const double deviation = std::sqrt(squares / (n - 2)), away = at - mean_x;
  const double t = kNormal * widening(static_cast<int>(x.size()) - 1);
  return {mean_y + slope * away, t * deviation * std::sqrt(1 + 1 / n + away * away / xx)};
}

TrendPrediction predict_process(std::span<const double> x, std::span<const double> y, double at) {
  const auto [low, high] = std::ranges::minmax(x);
  const auto unit = [low = low, high = high](double value) {
    return UnitPoint(UnitPoint::Constant(1, (value - low) / (high - low)));
  };
  std::vector<UnitPoint> points;
  Eigen::VectorXd values(static_cast<Eigen::Index>(y.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.push_back(unit(x[i]));
    values[static_cast<Eigen::Index>(i)] = y[i];
  }
  const GaussianProcess process(points, values);
  const auto prediction = process.predict(unit(at));
  return {prediction.mean, kNormal * std::sqrt(prediction.variance + process.noise_variance())};
}

}  // namespace

std::string_view name_of(TrendModel model) {
  return model == TrendModel::linear ? "linear" : "gaussian_process";
}

TrendPrediction predict_trend(std::span<const double> x, std::span<const double> y, double at, TrendModel model) {
  return model == TrendModel::linear ? predict_line(x, y, at) : predict_process(x, y, at);
}

}  // namespace pastefit
