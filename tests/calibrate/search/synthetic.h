#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/search/screening.h"
#include "tests/calibrate/search/objective.h"

namespace pastefit::synthetic {

inline const std::vector<std::uint64_t> one_packing{1};

/// A number in [0, 1) from a seed and a counter.
inline double uniform(std::uint64_t seed, std::uint64_t counter) {
  return std::ldexp(static_cast<double>(hash_of(seed, counter) >> 11), -53);
}

/// A number of mean 0 and variance 1 (sum of twelve uniforms).
inline double normal(std::uint64_t seed, std::uint64_t counter) {
  double sum = -6;
  for (std::uint64_t k = 0; k < 12; ++k) sum += uniform(seed, 12 * counter + k);
  return sum;
}

/// A number that changes with every bit of the point.
inline std::uint64_t digest(const UnitPoint& point) {
  std::uint64_t digest = 17;
  for (const double x : point) digest = hash_of(digest, static_cast<std::uint64_t>(std::ldexp(x, 52)));
  return digest;
}

/// What a failed simulation answers.
enum class FailureKind { graded, huge, infinite, not_a_number };

/// An objective made of functions; it counts its simulations like the real one: known answers are free.
class Synthetic : public Objective {
 public:
  int dimension = 2;
  std::vector<double> measured;             ///< target of each reading
  std::vector<double> standard_deviations;  ///< of each measurement
  std::function<std::vector<double>(const UnitPoint&, std::uint64_t packing)> observe;
  std::function<bool(const UnitPoint&, std::uint64_t packing)> fails = [](const UnitPoint&, std::uint64_t) {
    return false;
  };
  /// A laboratory would repeat the test where this is more than 1.
  std::function<double(const UnitPoint&, std::uint64_t packing)> rejection_index = [](const UnitPoint&, std::uint64_t) {
    return 0.0;
  };
  double allowed_share = 1;  ///< of rejected heaps; 1: not judged
  /// Residuals of what is known beforehand.
  std::function<std::vector<double>(const UnitPoint&)> known = [](const UnitPoint&) { return std::vector<double>{}; };
  FailureKind failure_kind = FailureKind::graded;
  /// A try whose first reading is off by more ends early: below it reads the level and nothing else, above it lacks the
  /// other readings. 0: every one runs to its end.
  double level = 0;
  double tolerance_mm = 5;              ///< of every reading that has none of its own
  std::vector<double> tolerances = {};  ///< of each reading; empty: `tolerance_mm`
  int budget = std::numeric_limits<int>::max();
  std::function<bool()> stop = [] { return false; };
  int cut_off_after = std::numeric_limits<int>::max();  ///< simulations: those after them are cut off by the stop

  std::vector<Response> answered;  ///< everything that was asked, in order
  int simulations = 0;

  int parameters() const override { return dimension; }
  int residuals() const override {
    return readings() + static_cast<int>(known(UnitPoint::Constant(dimension, 0.5)).size());
  }
  int readings() const override { return static_cast<int>(measured.size()); }
  int budget_left() const override { return budget - simulations; }
  double tolerance(std::size_t reading) const override {
    return tolerances.empty() ? tolerance_mm : tolerances.at(reading);
  }
  double allowance(std::size_t reading) const override { return tolerance(reading) / standard_deviations.at(reading); }
  ErrorUnit error_unit() const override { return {tolerance_mm}; }
  double rejected_share() const override { return allowed_share; }
  bool stop_requested() const override { return stop(); }

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override {
    return answers(points, packings, false);
  }
  std::vector<Response> try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override {
    return answers(points, packings, level > 0);
  }

 private:
  std::vector<Response> answers(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                bool tried) {
    std::vector<Response> responses;
    for (const UnitPoint& point : points) responses.push_back(answer(point, packings, tried));
    answered.insert(answered.end(), responses.begin(), responses.end());
    return responses;
  }

  void end_early(Evaluation& evaluation) const {
    const double difference = evaluation.readings[0] - measured[0];
    evaluation.censored = difference < -level || (difference > level && evaluation.readings.size() > 1);
    if (!evaluation.censored) return;
    std::fill(evaluation.readings.begin() + 1, evaluation.readings.end(), std::nan(""));
    evaluation.readings[0] = std::max(evaluation.readings[0], measured[0] - level);
  }

  Response answer(const UnitPoint& point, std::span<const std::uint64_t> packings, bool tried) {
    if (point.size() != dimension || !point.allFinite() || point.minCoeff() < 0 || point.maxCoeff() > 1) {
      throw std::logic_error("a point outside the unit cube was asked");
    }
    std::vector<Evaluation> evaluations;
    for (const std::uint64_t packing : packings) {
      Evaluation evaluation{point, packing, {}, std::nullopt};
      if (const bool cut_off = simulations >= cut_off_after; cut_off || fails(point, packing)) {
        evaluation.failure = Failure{};
        if (cut_off) evaluation.failure->reason = FailureReason::stopped;
      } else {
        evaluation.readings = observe(point, packing);
        evaluation.rejection_index = rejection_index(point, packing);
        if (tried) end_early(evaluation);
      }
      evaluation.simulations = known_.insert({digest(point), packing, evaluation.censored}).second ? 1 : 0;
      simulations += evaluation.simulations;
      evaluations.push_back(std::move(evaluation));
    }
    return response_of(std::move(evaluations));
  }

 public:
  Response response_of(std::vector<Evaluation> evaluations) const override {
    const int count = readings();
    Response response;
    response.point = evaluations.front().point;
    response.readings = Eigen::VectorXd::Zero(count);
    for (const Evaluation& evaluation : evaluations) {
      response.packings.push_back(evaluation.packing);
      response.failed = response.failed || evaluation.failure;
      response.censored = response.censored || evaluation.censored;
      response.rejected += evaluation.is_rejected() ? 1 : 0;
    }
    const auto judged = accepted(evaluations);
    for (const Evaluation* one : judged)
      for (int k = 0; k < count && !one->failure; ++k)
        response.readings[k] += one->readings[k] / static_cast<double>(judged.size());
    response.evaluations = std::move(evaluations);
    response.residuals.resize(residuals());
    const auto priors = known(response.point);
    for (std::size_t k = 0; k < priors.size(); ++k) response.residuals[count + static_cast<int>(k)] = priors[k];
    for (int k = 0; k < count; ++k) {
      double difference = response.readings[k] - measured[k];
      const auto bound = [&](const Evaluation& one) { return one.censored && one.readings[0] <= measured[0] - level; };
      if (std::isnan(difference)) difference = 0;
      if (k == 0 && std::ranges::any_of(response.evaluations, bound)) difference = std::min(difference, 0.0);
      response.residuals[k] = difference / standard_deviations[k];
      const double allowed = tolerance(static_cast<std::size_t>(k));
      response.error = std::max(response.error, std::abs(difference) / allowed);
      response.noise = std::max(response.noise, std::sqrt(squared_standard_error(response, k)) / allowed);
    }
    if (response.failed) response.residuals.setConstant(failure_value(response.point));
    response.misfit = 0.5 * response.residuals.squaredNorm();
    if (response.failed) response.error = std::abs(response.residuals[0]) / tolerance_mm;
    return response;
  }

 private:
  double failure_value(const UnitPoint& point) const {
    switch (failure_kind) {
      case FailureKind::graded:
        return 100 * (1 + point.sum());
      case FailureKind::huge:
        return 1e150;
      case FailureKind::infinite:
        return std::numeric_limits<double>::infinity();
      case FailureKind::not_a_number:
        return std::numeric_limits<double>::quiet_NaN();
    }
    return 0;
  }

  std::set<std::tuple<std::uint64_t, std::uint64_t, bool>> known_;
};

/// Residuals x - target: a bowl.
inline Synthetic bowl(const UnitPoint& target) {
  Synthetic objective;
  objective.dimension = static_cast<int>(target.size());
  objective.measured.assign(target.begin(), target.end());
  objective.standard_deviations.assign(objective.measured.size(), 1.0);
  objective.observe = [](const UnitPoint& x, std::uint64_t) { return std::vector<double>(x.begin(), x.end()); };
  return objective;
}

/// Rosenbrock's residuals 1 - u and 10 (v - u^2) on [-2, 2]^2, least at (0.75, 0.75).
inline Synthetic valley() {
  Synthetic objective;
  objective.measured = {0, 0};
  objective.standard_deviations = {1, 1};
  objective.observe = [](const UnitPoint& x, std::uint64_t) {
    const double u = 4 * x[0] - 2, v = 4 * x[1] - 2;
    return std::vector<double>{1 - u, 10 * (v - u * u)};
  };
  return objective;
}

/// Fails in a ball about `centre`; where `half` is set, beyond a plane through it.
inline auto failing_region(std::uint64_t seed, int dimension) {
  UnitPoint centre(dimension), normal_vector(dimension);
  for (int k = 0; k < dimension; ++k) {
    centre[k] = uniform(seed, 100 + k);
    normal_vector[k] = normal(seed, 200 + k);
  }
  const double radius = 0.05 + 0.6 * uniform(seed, 1);
  const bool half = uniform(seed, 2) < 0.4;
  return [=](const UnitPoint& x, std::uint64_t) {
    return half ? normal_vector.dot(x - centre) > 0 : (x - centre).norm() < radius;
  };
}

/// A bowl of 1 to 5 parameters that fails in a region, and a start that may lie in it.
struct FailingBowl {
  explicit FailingBowl(std::uint64_t seed) {
    const int dimension = 1 + static_cast<int>(seed % 5);
    UnitPoint target(dimension);
    start.resize(dimension);
    for (int k = 0; k < dimension; ++k) {
      target[k] = uniform(seed, 300 + k);
      start[k] = uniform(seed, 400 + k);
    }
    objective = bowl(target);
    objective.fails = failing_region(seed, dimension);
    objective.failure_kind = static_cast<FailureKind>(seed % 4);
  }

  Synthetic objective;
  UnitPoint start;
};

}  // namespace pastefit::synthetic
