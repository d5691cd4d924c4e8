#include "calibrate/search/reachability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/base/format.h"
#include "calibrate/models/gaussian_process.h"
#include "calibrate/optimisers/nlopt.h"

namespace pastefit {

namespace {

constexpr double sure = 3;            // standard deviations of doubt and noise that a candidate is given
constexpr double laboratory = 2;      // standard deviations of the laboratory within which a reading is met
constexpr double on_the_bound = 0.1;  // of a range: nearer than that a flat end of the model does not tell
constexpr double step_back = 0.2;     // of a range

/// One reading of all simulations that ended well, turned so that the laboratory lies below.
class Nearing {
 public:
  Nearing(std::span<const Response> singles, std::size_t reading, double tolerance)
      : reading_(static_cast<Eigen::Index>(reading)) {
    const Response* low = nullptr;
    const Response* high = nullptr;
    int above = 0;
    for (const Response& single : singles) {
      if (!is_feasible(single) || !has_reading(single, reading_)) continue;
      points_.push_back(single.point);
      if (!low || value_of(single) < value_of(*low)) low = &single;
      if (!high || value_of(single) > value_of(*high)) high = &single;
      above += single.residuals[reading_] > 0 ? 1 : -1;
      all_bounds_ = all_bounds_ && single.ended_early && single.residuals[reading_] < 0;
    }
    all_bounds_ = all_bounds_ && low && value_of(*high) == value_of(*low);
    one_side_ = low && std::abs(above) == static_cast<int>(points_.size()) && value_of(*high) > value_of(*low);
    if (!one_side_) return;
    // A residual is a multiple of the difference to the laboratory.
    deviation_ = (value_of(*high) - value_of(*low)) / (high->residuals[reading_] - low->residuals[reading_]);
    measured_ = value_of(*low) - deviation_ * low->residuals[reading_];
    side_ = above > 0 ? 1 : -1;
    met_ = std::max(laboratory * deviation_, tolerance);
    misses_.resize(static_cast<Eigen::Index>(points_.size()));
    Eigen::Index i = 0;
    for (const Response& single : singles)
      if (is_feasible(single) && has_reading(single, reading_)) misses_[i++] = side_ * (value_of(single) - measured_);
  }

  bool suspect() const { return one_side_ && misses_.minCoeff() > met_; }
  bool tells_nothing() const { return all_bounds_; }
  double met() const { return met_; }
  double measured() const { return measured_; }
  double side() const { return side_; }
  double least() const { return misses_.minCoeff(); }
  GaussianProcess model() const { return {points_, misses_}; }

 private:
  double value_of(const Response& single) const { return single.observables[reading_]; }

  Eigen::Index reading_;
  bool one_side_ = false;
  bool all_bounds_ = true;  // every simulation ended early and says only that it read less
  double side_ = 1, measured_ = 0, deviation_ = 1, met_ = 0;
  std::vector<UnitPoint> points_;
  Eigen::VectorXd misses_;
};

/// The miss that the model gives a candidate, so many deviations of its uncertainty and noise taken off.
double miss_at(const GaussianProcess& model, const UnitPoint& point, double deviations) {
  const auto prediction = model.predict(point);
  return prediction.mean - deviations * std::sqrt(prediction.variance + model.noise_variance());
}

/// The candidate of least miss. `scale`: a miss that counts as large.
UnitPoint nearest_by(const GaussianProcess& model, double deviations, double scale, const UnitPoint& start) {
  // Positive, in the order of the miss.
  return least_point([&](const UnitPoint& point) { return std::exp(miss_at(model, point, deviations) / scale); },
                     start);
}

/// The bounds that the nearest candidate lies on, where a step back costs more than the model's doubt there.
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

std::vector<UnitPoint> ended_early(std::span<const Response> singles, std::uint64_t packing) {
  std::vector<UnitPoint> points;
  for (const Response& single : singles)
    if (single.ended_early && single.packings.front() == packing) points.push_back(single.point);
  return points;
}

std::optional<OutOfReach> probe(Archive& archive, std::size_t reading, const ReachOptions& options, int& probes) {
  const int parameters = archive.parameters();
  const double tolerance = archive.tolerance(reading) * std::sqrt(archive.readings());
  while (!archive.stop_requested()) {
    const Nearing approach(archive.singles(), reading, tolerance);
    if (!approach.suspect() && !approach.tells_nothing()) return std::nullopt;
    // How far they would have gone is what matters here.
    if (const auto ended = ended_early(archive.singles(), options.packing); !ended.empty()) {
      if (archive.budget_left() < static_cast<int>(ended.size())) return std::nullopt;
      archive.evaluate(ended, {&options.packing, 1});
      continue;
    }
    if (!approach.suspect()) return std::nullopt;
    const GaussianProcess model = approach.model();
    const UnitPoint middle = UnitPoint::Constant(parameters, 0.5);
    const UnitPoint hopeful = nearest_by(model, sure, approach.least(), middle);
    const double at_best = miss_at(model, hopeful, sure);
    if (at_best > approach.met()) {
      OutOfReach found;
      found.reading = reading;
      found.above = approach.side() > 0;
      found.measured = approach.measured();
      found.nearest = nearest_by(model, 0, approach.least(), hopeful);
      found.likely = approach.measured() + approach.side() * miss_at(model, found.nearest, 0);
      found.at_best = approach.measured() + approach.side() * at_best;
      found.bounds = bounds_of(model, found.nearest);
      return found;
    }
    if (probes < 1 || archive.budget_left() < 1) return std::nullopt;
    --probes;
    const std::size_t before = archive.singles().size();
    archive.evaluate({&hopeful, 1}, {&options.packing, 1});
    if (archive.singles().size() == before) return std::nullopt;  // it was known, and taught nothing
  }
  return std::nullopt;
}

std::string name_at(std::span<const std::string> names, std::size_t index, const char* kind) {
  return index < names.size() ? names[index] : kind + std::to_string(index + 1);
}

}  // namespace

std::optional<OutOfReach> find_out_of_reach(Archive& archive, const ReachOptions& options) {
  int probes = options.probes;
  for (std::size_t k = 0; archive.any_feasible() && k < static_cast<std::size_t>(archive.readings()); ++k)
    if (auto found = probe(archive, k, options, probes)) return found;
  return std::nullopt;
}

std::string words_of(const OutOfReach& found, std::span<const std::string> readings,
                     std::span<const std::string> parameters) {
  std::string out =
      name_at(readings, found.reading, "reading ") + " is out of reach: the model stays " +
      format("%s the laboratory's %.3g. The %s it is likely to give within these bounds is %.3g",
             found.above ? "above" : "below", found.measured, found.above ? "least" : "most", found.likely) +
      format(", %s %.3g with all doubt and noise", found.above ? "no less than" : "no more than", found.at_best);
  if (found.bounds.empty()) return out + ". No bound stands in the way: it is the model, or its grains.";
  out += ". In the way ";
  out += found.bounds.size() == 1 ? "stands" : "stand";
  for (std::size_t i = 0; i < found.bounds.size(); ++i)
    out += std::string(i == 0 ? " the " : " and the ") + (found.bounds[i].upper ? "upper" : "lower") + " bound of " +
           name_at(parameters, static_cast<std::size_t>(found.bounds[i].parameter), "parameter ");
  return out + ".";
}

std::string words_of_screening(std::span<const Response> singles, std::span<const std::string> readings) {
  std::string out;
  const auto count = singles.empty() ? 0 : static_cast<std::size_t>(singles.front().observables.size());
  const std::vector<Reach> reach = reach_of(singles, std::vector<double>(count, 0.0));
  for (std::size_t k = 0; k < reach.size(); ++k) {
    const auto fitted = [&](const Response& single) { return single.residuals[static_cast<Eigen::Index>(k)] != 0; };
    if (std::ranges::none_of(singles, fitted)) continue;
    const Reach& one = reach[k];
    const bool or_less = std::ranges::any_of(singles, [&](const Response& single) {
      const auto i = static_cast<Eigen::Index>(k);
      return single.ended_early && single.residuals[i] < 0 && single.observables[i] == one.lowest;
    });
    out += (out.empty() ? "" : " ") + name_at(readings, k, "reading ") +
           format(" went from %.3g%s to %.3g, ", one.lowest, or_less ? " or less" : "", one.highest);
    if (one.all_above || one.all_below)
      out += std::string("always ") + (one.all_above ? "above" : "below") +
             " the laboratory, which may still be in reach.";
    else
      out += "the laboratory among them.";
  }
  return out;
}

}  // namespace pastefit
