#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "synthetic.h"

namespace pastefit::synthetic {

/// A synthetic objective on so many cores with a clock of its own: simulations start in the order in which they were
/// begun, and last 0.7 to 1.3 units, most of it the candidate's. The search itself takes no time.
class VirtualCores : public Objective {
 public:
  VirtualCores(Synthetic objective, int cores)
      : objective_(std::move(objective)), free_at_(static_cast<std::size_t>(cores), 0.0) {}

  int parameters() const override { return objective_.parameters(); }
  int residuals() const override { return objective_.residuals(); }
  int readings() const override { return objective_.readings(); }
  int budget_left() const override { return objective_.budget_left(); }
  bool stop_requested() const override { return objective_.stop_requested(); }
  double tolerance(std::size_t reading) const override { return objective_.tolerance(reading); }
  ErrorUnit error_unit() const override { return objective_.error_unit(); }
  Response response_of(std::vector<Evaluation> evaluations) const override {
    return objective_.response_of(std::move(evaluations));
  }

  void begin(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
             bool /*may_end_early*/) override {
    schedule(points, packings);
  }

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override {
    schedule(points, packings);
    for (const UnitPoint& point : points)
      for (const std::uint64_t packing : packings) now = std::max(now, ends_.at({digest(point), packing}));
    return objective_.evaluate(points, packings);
  }

  double now = 0;

 private:
  void schedule(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) {
    for (const UnitPoint& point : points) {
      for (const std::uint64_t packing : packings) {
        const auto [end, added] = ends_.try_emplace({digest(point), packing});
        if (!added) continue;
        const auto core = std::ranges::min_element(free_at_);
        const std::uint64_t at = digest(point);
        end->second = *core = std::max(now, *core) + 0.75 + 0.4 * uniform(at, 5) + 0.1 * uniform(at, packing);
      }
    }
  }

  Synthetic objective_;
  std::vector<double> free_at_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, double> ends_;
};

}  // namespace pastefit::synthetic
