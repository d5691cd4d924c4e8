#include "calibrate/search/proposals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrate/search/coarse_rung.h"
#include "core/random.h"

namespace pastefit {
namespace {

constexpr int coarse_tries = 4;  // proposals tried with coarse grains before one is with fine ones
constexpr double elsewhere = 3 * same_point;

/// A model that expects nothing good near some points.
class Avoiding : public Objective {
 public:
  Avoiding(Objective& model, std::vector<UnitPoint> avoided) : model_(model), avoided_(std::move(avoided)) {
    for (const UnitPoint& point : avoided_)
      penalty_ = std::max(penalty_, model_.evaluate({&point, 1}, no_packing).at(0).misfit);
  }
  int parameters() const override { return model_.parameters(); }
  int residuals() const override { return model_.residuals(); }
  int budget_left() const override { return model_.budget_left(); }
  bool stop_requested() const override { return false; }

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override {
    std::vector<Response> responses = model_.evaluate(points, packings);
    for (Response& response : responses)
      for (const UnitPoint& point : avoided_)
        response.misfit += penalty_ * std::exp(-(response.point - point).squaredNorm() / (elsewhere * elsewhere));
    return responses;
  }

 private:
  static constexpr std::array<std::uint64_t, 1> no_packing{0};
  Objective& model_;
  std::vector<UnitPoint> avoided_;
  double penalty_ = 0;
};

}  // namespace

std::optional<UnitPoint> Proposals::next() {
  Surrogate model(archive_.evidence());
  if (imagine_answers(model)) return std::nullopt;
  const UnitPoint proposal = tried_with_coarse_grains(least_point(model, archive_.best_point(common_)));
  if (was_asked(proposal)) return std::nullopt;
  return proposal;
}

std::optional<UnitPoint> Proposals::next_elsewhere() {
  Surrogate model(archive_.evidence());
  std::vector<UnitPoint> asked;
  for (const Response& one : archive_.history())
    if (std::ranges::equal(one.packings, common_)) asked.push_back(one.point);
  if (asked.empty()) return std::nullopt;
  Avoiding avoiding(model, std::move(asked));
  const UnitPoint proposal = least_point(avoiding, archive_.best_point(common_));
  if (was_asked(proposal)) return std::nullopt;
  return proposal;
}

UnitPoint Proposals::tried_with_coarse_grains(UnitPoint proposal) {
  for (int tries = 0; coarse_ && tries < coarse_tries && !archive_.stop_requested(); ++tries) {
    const std::size_t known = archive_.coarse_singles().size();
    archive_.evaluate_coarse(*coarse_, {&proposal, 1}, packings_of_coarse(options_.seed, options_.packings));
    if (archive_.coarse_singles().size() == known) break;
    Surrogate model(archive_.evidence());
    imagine_answers(model);
    const UnitPoint better = least_point(model, archive_.best_point(common_));
    const auto misfit = [&](const UnitPoint& point) { return model.evaluate({&point, 1}, common_).at(0).misfit; };
    if (misfit(proposal) <= misfit(better) + model.noise() / static_cast<double>(common_.size())) break;
    if (tries + 1 < coarse_tries) proposal = better;
  }
  return proposal;
}

/// Draws the answers of the candidates under way; true if one of them meets the goal.
bool Proposals::imagine_answers(Surrogate& model) const {
  const RandomStream random(options_.seed, "answers of candidates under way");
  bool met = false;
  std::uint64_t candidate = archive_.history().size();  // its place in the history to come
  for (const Archive::Asked& asked : archive_.under_way()) {
    Eigen::VectorXd luck(archive_.residuals());
    for (Eigen::Index k = 0; k < luck.size(); ++k)
      luck[k] = random.normal(candidate * static_cast<std::uint64_t>(luck.size()) + static_cast<std::uint64_t>(k));
    const Eigen::VectorXd answer = model.imagine(asked.point, static_cast<int>(asked.packings.size()), luck);
    met = met || 0.5 * answer.squaredNorm() <= goal_misfit();
    ++candidate;
  }
  return met;
}

/// The goal as a misfit, by the ratio of both in the best simulation.
double Proposals::goal_misfit() const {
  const auto best = archive_.best_single();
  return best && best->miss > 0 ? best->misfit * std::pow(goal_ / best->miss, 2) : 0;
}

bool Proposals::was_asked(const UnitPoint& point) const {
  const auto same = [&](const auto& asked) {
    return std::ranges::equal(asked.packings, common_) &&
           (asked.point - point).template lpNorm<Eigen::Infinity>() < same_point;
  };
  return std::ranges::any_of(archive_.history(), same) || std::ranges::any_of(archive_.under_way(), same);
}

}  // namespace pastefit
