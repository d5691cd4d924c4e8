#include "calibrate/inference/equivalent_material.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

constexpr double neighbourhood = 0.2;  // distance in the cube below which two materials count as one

}  // namespace

void spread_out(std::vector<UnitPoint>& chosen, const std::vector<UnitPoint>& points, std::size_t count, double apart) {
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

std::vector<UnitPoint> better_half(const ResponseModel& model, const std::vector<UnitPoint>& points) {
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t i = 0; i < points.size(); ++i) by_distance.emplace_back(model.distance(points[i]), i);
  std::ranges::sort(by_distance);
  std::vector<UnitPoint> half;
  for (std::size_t i = 0; i < (points.size() + 1) / 2; ++i) half.push_back(points[by_distance[i].second]);
  return half;
}

std::vector<UnitPoint> fitting(const ResponseModel& model, const std::vector<UnitPoint>& points,
                               const UnitPoint& recommended) {
  const auto error = [&](std::size_t k, const UnitPoint& point) {
    const ReadingTrainingData& reading = model.training_data().readings[k];
    return std::abs(model.expected(k, point) - *reading.measured) / reading.deviation;
  };
  const double as_well = std::max(1.0, model.distance(recommended));  // priors included
  std::vector<UnitPoint> out;
  std::ranges::copy_if(points, std::back_inserter(out), [&](const UnitPoint& point) {
    return model.is_known(point) && model.distance(point) <= as_well &&
           std::ranges::all_of(model.fitted(),
                               [&](std::size_t k) { return error(k, point) <= std::max(1.0, error(k, recommended)); });
  });
  return out;
}

std::vector<EquivalentMaterial> family_of(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                          const UnitPoint& recommended, const std::vector<ParameterInterval>& intervals,
                                          int count) {
  const TrainingData& evidence = model.training_data();
  const auto value = [&](const UnitPoint& point, std::size_t j) {
    return value_between(evidence.parameters[j], point[static_cast<Eigen::Index>(j)]);
  };
  const auto chosen_from = [&](const std::vector<UnitPoint>& candidates) {
    std::vector<UnitPoint> chosen = fitting(model, candidates, recommended);
    std::erase_if(chosen, [&](const UnitPoint& point) {
      for (std::size_t j = 0; j < intervals.size(); ++j)
        if (value(point, j) < intervals[j].lower || value(point, j) > intervals[j].upper) return true;
      return false;
    });
    return chosen;
  };
  const auto size = static_cast<std::size_t>(count);
  std::vector<UnitPoint> points{recommended};
  spread_out(points, chosen_from(evidence.points), size, neighbourhood);
  spread_out(points, chosen_from(better_half(model, sample)), size);
  std::vector<EquivalentMaterial> family;
  for (const UnitPoint& point : points) {
    EquivalentMaterial member;
    member.point = point;
    for (std::size_t j = 0; j < evidence.parameters.size(); ++j) member.values.push_back(value(point, j));
    for (const std::size_t k : model.fitted()) member.readings.push_back(model.expected(k, point));
    member.simulated = std::ranges::find(evidence.points, point) != evidence.points.end();
    member.distance = model.distance(point);
    family.push_back(std::move(member));
  }
  return family;
}

}  // namespace pastefit
