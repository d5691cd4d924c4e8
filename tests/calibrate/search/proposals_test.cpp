#include "calibrate/search/proposals.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <deque>

#include "answered.h"
#include "calibrate/search/search.h"
#include "fake_slump.h"
#include "virtual_cores.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

SearchOptions pending_options(std::uint64_t seed, int max_pending) {
  SearchOptions options = options_with(seed);
  options.max_pending = max_pending;
  return options;
}

const std::function<void(const Progress&)> nobody;
const std::vector<std::uint64_t> common{1001, 1002};

/// A history that has screened.
EvaluationHistory screened(Answered& answered, const SearchOptions& options) {
  EvaluationHistory history(answered.queue, {}, options, nobody);
  history.evaluate(screening_points(5, 12, options.seed), {common.data(), 1});
  answered.answers_of(history);
  return history;
}

/// A search that has screened, as its proposals find it.
struct Screened {
  Screened(std::uint64_t seed, int max_pending)
      : objective(fake_slump(150, seed)),
        options(pending_options(seed, max_pending)),
        answered(objective),
        history(screened(answered, options)),
        proposals(history, false, options) {}

  std::optional<UnitPoint> next() {
    CHECK(proposals.look({history, {}}));
    return proposals.found();
  }
  Response next_answer() {
    history.await_next();
    return answered.answers_of(history).front();
  }

  Synthetic objective;
  SearchOptions options;
  Answered answered;
  EvaluationHistory history;
  Proposals proposals;
};

struct Cost {
  double simulations = 0, time = 0;
  int confirmed = 0;
};

Cost cost_of(int max_pending, int cores, int seeds) {
  Cost cost;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto random = static_cast<std::uint64_t>(seed);
    VirtualCores objective(fake_heap(205, 275, random), cores);
    SearchOptions options = pending_options(random, max_pending);
    options.budget_simulations = 150;
    const Calibration calibration = search(objective, options);
    cost.simulations += calibration.simulations / static_cast<double>(seeds);
    cost.time += objective.now / seeds;
    if (calibration.status == CalibrationStatus::confirmed) ++cost.confirmed;
  }
  return cost;
}

}  // namespace

TEST_CASE(
    "candidates under way together are different ones, and what was answered is proposed again as the same point") {
  int several = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Screened search(seed, 3);
    EvaluationHistory& history = search.history;
    while (history.under_way().size() < 4) {
      const auto proposal = search.next();
      if (!proposal) break;
      for (const EvaluationHistory::Asked& asked : history.under_way())
        REQUIRE((asked.point - *proposal).lpNorm<Eigen::Infinity>() >= same_point);
      history.begin(*proposal, common.front());
    }
    REQUIRE(!history.under_way().empty());
    if (history.under_way().size() > 1) ++several;
    while (!history.under_way().empty()) search.next_answer();
    const auto next = search.next();
    if (!next) continue;
    for (const Response& seen : history.singles())
      CHECK((seen.point == *next || (seen.point - *next).lpNorm<Eigen::Infinity>() >= same_point));
  }
  CHECK(several >= 15);
}

TEST_CASE("where nothing promises an improvement that matters there is no proposal") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Screened easily_met(seed, 0), hardly_met(seed, 0);
    easily_met.objective.tolerance_mm = 1e6;
    hardly_met.objective.tolerance_mm = 1e-3;
    CHECK_FALSE(easily_met.next());
    CHECK(hardly_met.next());
  }
}

TEST_CASE("the improvement that a point promises is the mean of what its misfit falls short of the bound") {
  // Half the sum of two squared normal variables, by a sum over their quantiles.
  const double means[2] = {0.8, -0.3}, deviations[2] = {0.5, 1.1};
  double mean = 0, variance = 0;
  for (int k = 0; k < 2; ++k) {
    const double m = means[k] * means[k], v = deviations[k] * deviations[k];
    mean += 0.5 * (m + v);
    variance += v * (0.5 * v + m);
  }
  const Surrogate::MisfitPosterior misfit_posterior{0, mean, variance};
  constexpr double bound = 0.7;
  double improvement = 0;
  constexpr int draws = 200'000;
  for (std::uint64_t n = 0; n < draws; ++n) {
    double misfit = 0;
    for (std::uint64_t k = 0; k < 2; ++k) misfit += 0.5 * std::pow(means[k] + deviations[k] * normal(k + 1, n), 2);
    improvement += std::max(0.0, bound - misfit) / draws;
  }
  // Mean and variance are exact, the shape is a gamma distribution's.
  CHECK(misfit_posterior.improvement(bound) == Approx(improvement).epsilon(0.1));
  CHECK(Surrogate::MisfitPosterior{0, 0.4, 0}.improvement(bound) == Approx(bound - 0.4));
}

TEST_CASE("what is under way is spent, and answered in the order of asking") {
  Synthetic objective = fake_slump(150, 1);
  objective.budget = 60;
  Answered answered(objective);
  EvaluationHistory history = screened(answered, pending_options(1, 3));
  const int before = history.budget_left();
  const std::vector<UnitPoint> points = screening_points(5, 3, 9);
  for (const UnitPoint& point : points) history.begin(point, common.front());
  CHECK(history.budget_left() == before - 3);
  for (const UnitPoint& point : points) {
    history.await_next();
    CHECK(answered.answers_of(history).front().point == point);
  }
  CHECK(history.budget_left() == before - 3);
  CHECK(history.under_way().empty());
}

TEST_CASE("with more candidates pending so many are under way, and no more than the budget allows", "[campaign]") {
  for (const int max_pending : {0, 1, 3}) {
    CAPTURE(max_pending);
    std::size_t most = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Synthetic slump = fake_slump(150, seed);
      slump.tolerance_mm = 0.1;  // no candidate is good enough
      Search search(slump, pending_options(seed, max_pending), {.simulations = 60});
      std::deque<Candidate> under_way;
      while (!search.finished()) {
        const auto candidates = search.suggest(1);
        std::ranges::copy(candidates, std::back_inserter(under_way));
        const auto is_proposal = [](const Candidate& one) { return one.purpose == "search" && one.may_end_early; };
        most = std::max(most, static_cast<std::size_t>(std::ranges::count_if(under_way, is_proposal)));
        if (!candidates.empty() || under_way.empty()) continue;
        const Candidate first = under_way.front();
        under_way.pop_front();
        const CandidateResult result{first.number,
                                     slump.try_out({&first.point, 1}, {&first.packing, 1}).at(0).evaluations.at(0)};
        search.ingest({&result, 1});
      }
      CHECK(search.result().simulations <= 60);
    }
    CHECK(most == static_cast<std::size_t>(max_pending) + 1);
  }
}

TEST_CASE("a second candidate pending costs simulations, and saves time", "[campaign]") {
  const int seeds = 40;
  std::vector<std::vector<Cost>> costs;  // by candidates pending and cores
  for (const int max_pending : {0, 1}) {
    costs.emplace_back();
    for (const int cores : {2, 8}) {
      const Cost cost = costs.back().emplace_back(cost_of(max_pending, cores, seeds));
      UNSCOPED_INFO("pending " << max_pending << ", " << cores << " cores: " << cost.simulations << " simulations, "
                               << cost.time << " units of time");
      CHECK(cost.confirmed >= 0.95 * seeds);
    }
  }
  CHECK(costs[1][0].simulations == costs[1][1].simulations);  // cores change the time alone
  CHECK(costs[1][0].simulations < 1.4 * costs[0][0].simulations);
  CHECK(costs[1][0].time < costs[0][0].time);
  CHECK(costs[1][1].time < costs[0][1].time);
}
