#include "calibrate/models/reading_model.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "calibrate/search/screening.h"
#include "tests/calibrate/search/synthetic.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

using Answers = std::vector<ReadingModel::Answer>;
using Function = std::function<double(const UnitPoint&)>;

/// Simulations of each site, as many as there are heaps; below `cutoff` they end.
Answers answers_of(const std::vector<UnitPoint>& sites, const Function& mean, const Function& noise, int heaps,
                   double cutoff = -1e9) {
  Answers answers;
  for (std::size_t site = 0; site < sites.size(); ++site) {
    for (int heap = 0; heap < heaps; ++heap) {
      const double value = mean(sites[site]) + noise(sites[site]) * normal(site, static_cast<std::uint64_t>(heap));
      answers.push_back({site, std::max(value, cutoff), value <= cutoff});
    }
  }
  return answers;
}

Function always(double value) {
  return [value](const UnitPoint&) { return value; };
}

/// A line along the first of two coordinates.
double rising(const UnitPoint& x) {
  return 100 * x[0];
}

}  // namespace

TEST_CASE("a model is nearer to the mean than the noise of one simulation, and knows how near") {
  const auto sites = screening_points(2, 30, 1);
  const ReadingModel model(sites, answers_of(sites, rising, always(4), 1));
  double squares = 0, expected = 0;
  for (const UnitPoint& point : screening_points(2, 64, 7)) {
    const auto known = model.predict(point);
    squares += std::pow(known.mean - rising(point), 2) / 64;
    expected += known.variance / 64;
  }
  CHECK(squares < 4 * 4 / 3.0);
  CHECK(squares / expected < 2.5);
  CHECK(squares / expected > 0.25);
}

TEST_CASE("a change between neighbours is known better than the readings of both") {
  const auto sites = screening_points(2, 30, 1);
  const ReadingModel model(sites, answers_of(sites, rising, always(4), 1));
  const UnitPoint from = sites[3], to = from + 0.1 * (UnitPoint(2) << 1 - from[0], 0).finished();
  const auto change = model.change(from, to);
  const auto before = model.predict(from), after = model.predict(to);
  CHECK(change.mean == Approx(after.mean - before.mean));
  CHECK(std::abs(change.mean - (rising(to) - rising(from))) < 3 * std::sqrt(change.variance));
  CHECK(change.variance > 0);
  CHECK(change.variance < before.variance + after.variance);
}

TEST_CASE("a trend is followed where there are no simulations") {
  std::vector<UnitPoint> sites;
  for (const UnitPoint& point : screening_points(2, 60, 1))
    if (point[0] < 0.5) sites.push_back(point);
  const ReadingModel model(sites, answers_of(sites, rising, always(1), 1));
  const auto far = model.predict(Eigen::Vector2d(0.8, 0.5)), near = model.predict(Eigen::Vector2d(0.3, 0.5));
  CHECK(std::abs(far.mean - 80) < 2 * std::sqrt(far.variance));
  CHECK(far.mean > 70);
  CHECK(far.variance > near.variance);
}

TEST_CASE("noise is learnt where it is") {
  const Function noise = [](const UnitPoint& x) { return 1 + 15 * std::exp(-0.5 * std::pow((x[0] - 0.5) / 0.15, 2)); };
  const auto sites = screening_points(2, 40, 1);
  const ReadingModel model(sites, answers_of(sites, rising, noise, 2));
  const double made = noise(Eigen::Vector2d(0.5, 0.5));
  CHECK(model.noise_at(50) < 1.5 * made);
  CHECK(model.noise_at(50) > made / 1.5);
  for (const double height : {2.0, 98.0}) CHECK(model.noise_at(height) < made / 5);
}

TEST_CASE("simulations that ended early do not flatten the model above their bound") {
  const auto sites = screening_points(2, 40, 1);
  const Answers whole = answers_of(sites, rising, always(2), 1), cut = answers_of(sites, rising, always(2), 1, 40);
  Answers equal = cut;
  for (ReadingModel::Answer& answer : equal) answer.is_bound = false;
  const ReadingModel true_model(sites, whole), model(sites, cut), misled(sites, equal);
  double off = 0, misled_off = 0;
  for (const double x : {0.42, 0.46, 0.5}) {
    const Eigen::Vector2d point(x, 0.5);
    off = std::max(off, std::abs(model.predict(point).mean - true_model.predict(point).mean));
    misled_off = std::max(misled_off, std::abs(misled.predict(point).mean - true_model.predict(point).mean));
  }
  CHECK(off < 2);
  CHECK(off < misled_off);
  const auto below = model.predict(Eigen::Vector2d(0.1, 0.5));
  CHECK(below.mean < 40);
  CHECK(below.variance > 4 * true_model.predict(Eigen::Vector2d(0.1, 0.5)).variance);
}

TEST_CASE("a bound far above the mean says nothing, one below it draws the mean down") {
  const auto sites = screening_points(2, 20, 1);
  Answers answers = answers_of(sites, rising, always(2), 1);
  const std::vector<UnitPoint> probe{Eigen::Vector2d(0.52, 0.48)};
  std::vector<UnitPoint> more = sites;
  more.push_back(probe[0]);
  const double before = ReadingModel(more, answers).predict(probe[0]).mean;
  answers.push_back({sites.size(), 99, true});
  CHECK(ReadingModel(more, answers).predict(probe[0]).mean == Approx(before).margin(1));
  answers.back().value = before - 6;
  const double after = ReadingModel(more, answers).predict(probe[0]).mean;
  CHECK(after < before - 0.5);
  CHECK(after > before - 6);
}

TEST_CASE("answers that are all the same are known") {
  const auto sites = screening_points(2, 5, 1);
  const ReadingModel model(sites, answers_of(sites, always(300), always(0), 1));
  CHECK(model.predict(sites[0]).mean == 300);
  CHECK(model.predict(sites[0]).variance == 0);
  CHECK(model.noise_at(300) == 0);
}
