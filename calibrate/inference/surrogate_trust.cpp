#include "calibrate/inference/surrogate_trust.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace pastefit {

namespace {

constexpr double kJump = 10;         // [standard deviations of the measurement]
constexpr double kJumpAlone = 3;     // the same for one parameter: neighbours are then as informative as a model
constexpr double kScatter = 4;       // [standard deviations between packings of one candidate]
constexpr std::size_t kNearest = 2;  // sites for each parameter

/// Uncensored answers of each site.
std::vector<Replicates> answers_of(const ReadingTrainingData& reading, const Sites& sites) {
  std::vector<Replicates> out(sites.points.size());
  for (std::size_t i = 0; i < sites.of.size(); ++i)
    if (const double value = reading.simulated[i]; !std::isnan(value) && !reading.bound(i)) out[sites.of[i]].add(value);
  return out;
}

/// Standard deviation between packings: median over the candidates with several, because some candidates collapse on
/// some packings only; none without replicates.
std::optional<double> scatter_of(const std::vector<Replicates>& answers) {
  std::vector<double> variances;
  for (const Replicates& one : answers)
    if (one.weight >= 2) variances.push_back(one.squares / (one.weight - 1));
  if (variances.empty()) return std::nullopt;
  const auto middle = variances.begin() + std::ssize(variances) / 2;
  std::ranges::nth_element(variances, middle);
  return std::sqrt(*middle);
}

}  // namespace

SurrogateTrust::SurrogateTrust(const TrainingData& evidence, const Sites& sites, std::span<const ReadingModel> models,
                               std::span<const std::size_t> fitted)
    : places_(sites.points), doubtful_(sites.points.size(), false) {
  std::vector<double> scatter;
  for (const std::size_t k : fitted) {
    const ReadingTrainingData& reading = evidence.readings[k];
    const std::optional<double> replicates = scatter_of(answers_of(reading, sites));
    scatter.push_back(replicates.value_or(models[k].noise_at(*reading.measured)));
    const double jump = evidence.parameters.size() == 1 ? kJumpAlone : kJump;
    const double most = std::max(jump * reading.deviation, kScatter * replicates.value_or(0));
    const std::vector<double> errors = models[k].leave_one_out();
    for (std::size_t row = 0; row < errors.size(); ++row)
      if (std::abs(errors[row]) > most) doubtful_[models[k].rows()[row].site] = true;
  }
  any_doubtful_ = std::ranges::find(doubtful_, true) != doubtful_.end();
  if (evidence.parameters.size() == 1) line_up(evidence, sites, scatter, fitted);
}

void SurrogateTrust::line_up(const TrainingData& evidence, const Sites& sites, std::span<const double> scatter,
                             std::span<const std::size_t> fitted) {
  for (const std::size_t k : fitted) measured_.push_back(*evidence.readings[k].measured);
  for (std::size_t site = 0; site < places_.size(); ++site) {
    Neighbour one{places_[site][0], {}, {}, {}};
    for (std::size_t k = 0; k < fitted.size(); ++k) {
      const ReadingTrainingData& reading = evidence.readings[fitted[k]];
      Replicates answers;
      for (std::size_t i = 0; i < sites.of.size(); ++i) {
        const double value = reading.simulated[i];
        if (sites.of[i] == site && !std::isnan(value)) answers.add(value);
      }
      if (answers.weight == 0) break;
      one.means.push_back(answers.mean);
      one.weights.push_back(answers.weight);
    }
    if (one.means.size() == fitted.size()) line_.push_back(std::move(one));
  }
  std::ranges::sort(line_, {}, &Neighbour::coordinate);
  if (line_.size() < 2) return line_.clear();
  uses_neighbours_ = any_doubtful_;
  for (std::size_t i = 0; i < line_.size(); ++i) {
    const Neighbour &left = line_[i > 0 ? i - 1 : 1], &right = line_[i + 1 < line_.size() ? i + 1 : i - 1];
    Neighbour& one = line_[i];
    for (std::size_t k = 0; k < fitted.size(); ++k) {
      // Far from the jump, replicate scatter is at most the difference from the neighbours.
      const double apart = std::max(std::abs(one.means[k] - left.means[k]), std::abs(one.means[k] - right.means[k]));
      const double noise = std::min(scatter[k], apart);
      one.variances.push_back(evidence.readings[fitted[k]].variance() + noise * noise / one.weights[k]);
    }
  }
}

bool SurrogateTrust::predicts(const UnitPoint& point) const {
  if (uses_neighbours_) return false;
  if (!any_doubtful_) return true;
  std::vector<std::size_t> order(places_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(kNearest * static_cast<std::size_t>(point.size()), order.size());
  std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(count), {},
                            [&](std::size_t i) { return (places_[i] - point).squaredNorm(); });
  return std::none_of(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                      [&](std::size_t i) { return doubtful_[i]; });
}

double SurrogateTrust::log_likelihood(double coordinate) const {
  if (line_.empty()) return 0;
  const auto above = std::ranges::lower_bound(line_, coordinate, {}, &Neighbour::coordinate);
  const Neighbour& right = above == line_.end() ? line_.back() : *above;
  const Neighbour& left = above == line_.begin() ? line_.front() : *std::prev(above);
  double sum = 0;
  for (std::size_t k = 0; k < measured_.size(); ++k) {
    const auto [low, high] = std::minmax(left.means[k], right.means[k]);
    const double off = std::max({low - measured_[k], measured_[k] - high, 0.0});
    const double variance =
        (left.means[k] < right.means[k]) == (measured_[k] < low) ? left.variances[k] : right.variances[k];
    sum -= 0.5 * off * off / variance;
  }
  return sum;
}

std::vector<double> SurrogateTrust::coordinates() const {
  std::vector<double> out;
  for (const UnitPoint& place : places_) out.push_back(place[0]);
  std::ranges::sort(out);
  return out;
}

}  // namespace pastefit
