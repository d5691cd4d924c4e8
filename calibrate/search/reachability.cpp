#include "calibrate/search/reachability.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "calibrate/base/text.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/optimisers/problem.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

namespace {

constexpr double sure = 3;             // standard deviations between mean and confidence bound for known variances
constexpr double laboratory = 2;       // standard deviations of the measurement within which a reading is met
constexpr double on_the_bound = 0.1;   // of a range: counts as on the bound where the model is flat
constexpr double step_back = 0.2;      // of a range
constexpr std::size_t neighbours = 4;  // of a point; all must have finished

/// Differences between one reading and the measurement over all feasible simulations, in the reading's unit, with the
/// sign that makes them positive (misses).
class Nearing {
 public:
  Nearing(std::span<const Response> singles, std::size_t reading, double tolerance) : reading_(reading) {
    const Response* low = nullptr;
    const Response* high = nullptr;
    int above = 0;
    for (const Response& single : singles) {
      note_run(single);
      if (!is_feasible(single) || !has_reading(single, reading_)) continue;
      points_.push_back(single.point);
      if (is_fine(single) && (!low || value_of(single) < value_of(*low))) low = &single;
      if (is_fine(single) && (!high || value_of(single) > value_of(*high))) high = &single;
      above += single.residuals[reading_] > 0 ? 1 : -1;
      all_bounds_ = all_bounds_ && single.censored && single.residuals[reading_] < 0;
    }
    all_bounds_ = all_bounds_ && low && value_of(*high) == value_of(*low);
    one_side_ = low && std::abs(above) == static_cast<int>(points_.size()) && value_of(*high) > value_of(*low);
    if (!one_side_) return;
    // A residual is the difference over the standard deviation of the measurement.
    deviation_ = (value_of(*high) - value_of(*low)) / (high->residuals[reading_] - low->residuals[reading_]);
    measured_ = value_of(*low) - deviation_ * low->residuals[reading_];
    side_ = above > 0 ? 1 : -1;
    met_ = std::max(laboratory * deviation_, tolerance);
    misses_.resize(points_.size());
    Eigen::Index i = 0;
    for (const Response& single : singles)
      if (is_feasible(single) && has_reading(single, reading_))
        misses_[i++] = side_ * deviation_ * single.residuals[reading_];
  }

  bool suspect() const { return one_side_ && misses_.minCoeff() > met_; }
  bool tells_nothing() const { return all_bounds_; }
  std::size_t reading() const { return reading_; }
  double met() const { return met_; }
  double measured() const { return measured_; }
  double side() const { return side_; }
  double least() const { return misses_.minCoeff(); }
  GaussianProcess model() const { return {points_, misses_}; }
  UnitPoint middle() const { return UnitPoint::Constant(points_.front().size(), 0.5); }

  /// Quantile of Student's t at the probability of `sure` standard deviations of a normal distribution.
  double deviations() const {
    const double probability = boost::math::cdf(boost::math::normal_distribution<>(), sure);
    const double freedom = std::max<double>(1, static_cast<double>(points_.size()) - 1);
    return boost::math::quantile(boost::math::students_t_distribution<>(freedom), probability);
  }

  /// True if more candidates finished than did not, and all `neighbours` nearest to a point did.
  bool vouches_for(const UnitPoint& place) const {
    if (2 * std::ranges::count_if(runs_, &Run::finished) <= std::ssize(runs_)) return false;
    std::vector<Run> nearest = runs_;
    const auto distance = [&](const Run& one) { return (one.point - place).squaredNorm(); };
    std::ranges::stable_sort(nearest, {}, distance);
    nearest.resize(std::min(neighbours, nearest.size()));
    return std::ranges::all_of(nearest, &Run::finished);
  }

 private:
  struct Run {
    UnitPoint point;
    bool finished = false;  // on some packing
  };

  void note_run(const Response& single) {
    auto known = std::ranges::find_if(runs_, [&](const Run& one) { return one.point == single.point; });
    if (known == runs_.end()) known = runs_.insert(known, {single.point, false});
    known->finished = known->finished || is_whole(single);
  }

  /// Coarse simulations: only their residuals are corrected for the grain size, not their readings.
  static bool is_fine(const Response& single) { return single.packings.front() < coarse_packings; }
  double value_of(const Response& single) const { return single.readings[reading_]; }

  std::size_t reading_;
  bool one_side_ = false;
  bool all_bounds_ = true;  // every simulation ended early with only an upper bound
  double side_ = 1, measured_ = 0, deviation_ = 1, met_ = 0;
  std::vector<UnitPoint> points_;
  Eigen::VectorXd misses_;
  std::vector<Run> runs_;
};

/// How far below its predicted mean the miss of a candidate may lie.
struct Allowance {
  double deviations = 0;  ///< standard deviations of predictive variance and noise together
  double noise = 0;       ///< variance of the noise [squared unit of the reading]
};

/// Lower confidence bound of the miss [unit of the reading].
double miss_at(const GaussianProcess& model, const UnitPoint& point, const Allowance& allowance) {
  const auto prediction = model.predict(point);
  return prediction.mean - allowance.deviations * std::sqrt(prediction.variance + allowance.noise);
}

/// Point of least lower confidence bound of the miss. `scale`: a large miss [unit of the reading].
UnitPoint nearest_by(const GaussianProcess& model, const Allowance& allowance, double scale, const UnitPoint& start) {
  // Positive, as `least_point` requires, and increasing with the bound.
  return least_point([&](const UnitPoint& point) { return std::exp(miss_at(model, point, allowance) / scale); }, start);
}

/// Bounds of the nearest candidate from which a step inwards increases the predicted miss by more than its predictive
/// standard deviation.
std::vector<OutOfReach::Bound> bounds_of(const GaussianProcess& model, const UnitPoint& nearest) {
  std::vector<OutOfReach::Bound> bounds;
  const auto here = model.predict(nearest);
  for (Eigen::Index j = 0; j < nearest.size(); ++j) {
    const bool upper = nearest[j] > 1 - on_the_bound;
    if (!upper && nearest[j] > on_the_bound) continue;
    UnitPoint back = nearest;
    back[j] += upper ? -step_back : step_back;
    if (model.predict(back).mean - here.mean > std::sqrt(here.variance)) bounds.push_back({static_cast<int>(j), upper});
  }
  return bounds;
}

std::vector<UnitPoint> censored(std::span<const Response> singles, std::uint64_t packing) {
  std::vector<UnitPoint> points;
  for (const Response& single : singles)
    if (single.censored && single.packings.front() == packing) points.push_back(single.point);
  return points;
}

/// Claims that a reading is out of reach; `hopeful`: point of least bound. None if this bound meets the measurement or
/// too few simulations have finished.
std::optional<OutOfReach> claim(const Nearing& approach, const GaussianProcess& model, const Allowance& allowance,
                                const UnitPoint& hopeful) {
  const double at_best = miss_at(model, hopeful, allowance);
  if (at_best <= approach.met() || !approach.vouches_for(hopeful)) return std::nullopt;
  OutOfReach found;
  found.reading = approach.reading();
  found.above = approach.side() > 0;
  found.measured = approach.measured();
  found.nearest = nearest_by(model, {}, approach.least(), hopeful);
  found.likely = approach.measured() + approach.side() * miss_at(model, found.nearest, {});
  found.at_best = approach.measured() + approach.side() * at_best;
  found.bounds = bounds_of(model, found.nearest);
  if (!approach.vouches_for(found.nearest)) return std::nullopt;
  return found;
}

/// Point that may come nearest to the measurement.
UnitPoint hopeful_of(const Nearing& approach, const GaussianProcess& model, const Allowance& allowance) {
  return nearest_by(model, allowance, approach.least(), approach.middle());
}

std::string name_at(std::span<const std::string> names, std::size_t index, const char* kind) {
  return index < names.size() ? names[index] : kind + std::to_string(index + 1);
}

}  // namespace

bool ReachPhase::advance() {
  for (; history_.any_feasible() && reading_ < static_cast<std::size_t>(history_.readings()); ++reading_) {
    if (!probe()) return false;
    if (found_) return true;
    known_.reset();
  }
  return true;
}

bool ReachPhase::probe() {
  if (history_.stop_requested()) return true;
  if (known_ && history_.singles().size() == *known_) return true;  // the probe was already known: nothing new
  known_.reset();
  const Nearing approach(history_.singles(), reading_, history_.tolerance(reading_));
  if (!approach.suspect() && !approach.tells_nothing()) return true;
  // The readings of stopped simulations are needed in full.
  if (const auto ended = censored(history_.singles(), packing_); !ended.empty()) {
    if (history_.budget_left() < static_cast<int>(ended.size())) return true;
    history_.evaluate(ended, {&packing_, 1});
    return false;
  }
  if (!approach.suspect()) return true;
  const GaussianProcess model = approach.model();
  const Allowance allowance{approach.deviations(), model.noise_variance()};
  const UnitPoint hopeful = hopeful_of(approach, model, allowance);
  found_ = claim(approach, model, allowance, hopeful);
  if (found_ || probes_ >= most_probes_ || history_.budget_left() < 1) return true;
  ++probes_;
  known_ = history_.singles().size();
  history_.evaluate({&hopeful, 1}, {&packing_, 1});
  return false;
}

std::optional<OutOfReach> known_out_of_reach(const EvaluationHistory& history, ReachOf what) {
  const std::vector<Response> evidence = history.training_data();
  for (std::size_t k = 0; history.any_feasible() && k < static_cast<std::size_t>(history.readings()); ++k) {
    const Nearing approach(evidence, k, history.tolerance(k));
    if (!approach.suspect()) continue;
    const GaussianProcess model = approach.model();
    const double noise = what == ReachOf::simulations ? model.noise_variance() : 0;
    const Allowance allowance{approach.deviations(), noise};
    if (auto found = claim(approach, model, allowance, hopeful_of(approach, model, allowance))) return found;
  }
  return std::nullopt;
}

bool contradicts(const Response& single, const OutOfReach& found) {
  if (!is_whole(single) || !has_reading(single, found.reading)) return false;
  const double read = single.readings[found.reading];
  return found.above ? read <= found.at_best : read >= found.at_best;
}

std::string describe(const OutOfReach& found, std::span<const std::string> readings,
                     std::span<const std::string> parameters) {
  std::string out =
      name_at(readings, found.reading, "reading ") + " is out of reach: all simulated values are " +
      format("%s the measured %.3g. The %s predicted value within these bounds is %.3g",
             found.above ? "above" : "below", found.measured, found.above ? "smallest" : "largest", found.likely) +
      format(", %s %.3g with 99.9 %% probability", found.above ? "at least" : "at most", found.at_best);
  if (found.bounds.empty()) return out + ". The limit is not a bound but the model or its grains.";
  out += found.bounds.size() == 1 ? ". The limit is" : ". The limits are";
  for (std::size_t i = 0; i < found.bounds.size(); ++i)
    out += std::string(i == 0 ? " the " : " and the ") + (found.bounds[i].upper ? "upper" : "lower") + " bound of " +
           name_at(parameters, found.bounds[i].parameter, "parameter ");
  return out + ".";
}

std::string describe_withdrawal(const OutOfReach& found, std::span<const std::string> readings) {
  return name_at(readings, found.reading, "reading ") +
         " may be in reach after all: a simulation came nearer than expected, and the search continues.";
}

std::string describe_screening(std::span<const Response> singles, std::span<const std::string> readings) {
  std::string out;
  const auto count = singles.empty() ? 0 : static_cast<std::size_t>(singles.front().readings.size());
  const std::vector<Reach> reach = reach_of(singles, std::vector<double>(count, 0.0));
  for (std::size_t k = 0; k < reach.size(); ++k) {
    const auto fitted = [&](const Response& single) { return single.residuals[k] != 0; };
    if (std::ranges::none_of(singles, fitted)) continue;
    const Reach& one = reach[k];
    const bool or_less = std::ranges::any_of(singles, [&](const Response& single) {
      return single.censored && single.residuals[k] < 0 && single.readings[k] == one.lowest;
    });
    out += (out.empty() ? "" : " ") + name_at(readings, k, "reading ") +
           format(": simulated values from %.3g%s to %.3g, ", one.lowest, or_less ? " or less" : "", one.highest);
    if (one.all_above || one.all_below)
      out +=
          std::string("all ") + (one.all_above ? "above" : "below") + " the measured one, which may still be in reach.";
    else
      out += "on both sides of the measured one.";
  }
  return out;
}

}  // namespace pastefit
