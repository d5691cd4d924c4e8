#include "calibrate/search/proposals.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "fake_slump.h"
#include "virtual_cores.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

SearchOptions lagging_options(std::uint64_t seed, int lag) {
  SearchOptions options = options_with(seed);
  options.lag = lag;
  return options;
}

const std::function<void(const Progress&)> nobody;
const std::vector<std::uint64_t> common{1001, 1002};

/// A archive that has screened.
Archive screened(Objective& objective, const SearchOptions& options) {
  Archive archive(objective, options, nobody);
  archive.evaluate(screening_points(5, 12, options.seed), {common.data(), 1});
  return archive;
}

/// A search that has screened, as its proposals find it.
struct Screened {
  Screened(std::uint64_t seed, int lag)
      : objective(fake_slump(150, seed)),
        options(lagging_options(seed, lag)),
        archive(screened(objective, options)),
        proposals(archive, nullptr, options, common, 0.1) {}

  Synthetic objective;
  SearchOptions options;
  Archive archive;
  Proposals proposals;
};

struct Cost {
  double simulations = 0, time = 0;
  int confirmed = 0;
};

Cost cost_of(int lag, int cores, int seeds) {
  Cost cost;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto random = static_cast<std::uint64_t>(seed);
    VirtualCores objective(fake_slump(40 + 250 * uniform(random, 77), random), cores);
    const Calibration calibration = search(objective, lagging_options(random, lag));
    cost.simulations += calibration.simulations / static_cast<double>(seeds);
    cost.time += objective.now / seeds;
    if (calibration.status == CalibrationStatus::confirmed) ++cost.confirmed;
  }
  return cost;
}

}  // namespace

TEST_CASE("candidates under way together are different ones, and none is one that was answered") {
  int several = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Screened search(seed, 3);
    auto& [objective, options, archive, proposals] = search;
    while (archive.under_way().size() < 4) {
      const auto proposal = proposals.next();
      if (!proposal) break;
      for (const Archive::Asked& asked : archive.under_way())
        REQUIRE((asked.point - *proposal).lpNorm<Eigen::Infinity>() >= same_point);
      archive.begin(*proposal, common);
    }
    REQUIRE(!archive.under_way().empty());
    if (archive.under_way().size() > 1) ++several;
    while (!archive.under_way().empty()) archive.next_answer();
    const auto next = proposals.next();
    if (!next) continue;
    for (const Response& seen : archive.history())
      if (std::ranges::equal(seen.packings, common))
        CHECK((seen.point - *next).lpNorm<Eigen::Infinity>() >= same_point);
  }
  CHECK(several >= 15);
}

TEST_CASE(
    "beside candidates that were refuted the next one lies apart from all of them, and is expected to do as well") {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Screened search(seed, 0);
    auto& [objective, options, archive, proposals] = search;
    CHECK_FALSE(proposals.next_elsewhere());  // nothing was asked on the common packings
    for (int k = 0; k < 6; ++k) {
      const auto proposal = proposals.next();
      if (!proposal) break;
      archive.evaluate({&*proposal, 1}, common);
    }
    const auto beside = proposals.next_elsewhere();
    if (!beside) continue;
    ++found;
    for (const Response& seen : archive.history())
      if (std::ranges::equal(seen.packings, common)) CHECK((seen.point - *beside).norm() >= 2 * same_point);
    Surrogate model(archive.evidence());
    CHECK(std::abs(model.evaluate({&*beside, 1}, common).at(0).residuals[0]) <= 2);  // in the laboratory's deviations
  }
  CHECK(found >= 18);
}

TEST_CASE("a candidate under way that is likely to meet the goal is waited for") {
  int waited = 0, waited_for_none = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Synthetic objective = fake_slump(150, seed);
    const SearchOptions options = lagging_options(seed, 1);
    Archive archive = screened(objective, options);
    Proposals generous(archive, nullptr, options, common, 200), strict(archive, nullptr, options, common, 1e-3);
    archive.begin(generous.next().value(), common);
    if (!generous.next()) ++waited;
    if (!strict.next()) ++waited_for_none;
  }
  CHECK(waited == 20);
  CHECK(waited_for_none <= 5);
}

TEST_CASE("what is under way is spent, and answered in the order of asking") {
  Synthetic objective = fake_slump(150, 1);
  objective.budget = 60;
  Archive archive = screened(objective, lagging_options(1, 3));
  const int before = archive.budget_left();
  const std::vector<UnitPoint> points = screening_points(5, 3, 9);
  for (const UnitPoint& point : points) archive.begin(point, common);
  CHECK(archive.budget_left() == before - 6);
  for (const UnitPoint& point : points) CHECK(archive.next_answer().point == point);
  CHECK(archive.budget_left() == before - 6);
  CHECK(archive.under_way().empty());
}

TEST_CASE("with a lag so many candidates more are under way, and no more than the budget allows") {
  for (const int lag : {0, 1, 3}) {
    CAPTURE(lag);
    std::size_t most = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Synthetic slump = fake_slump(150, seed);
      slump.tolerance_mm = 0.1;  // no candidate is so good that it is waited for
      VirtualCores objective(slump, 64);
      CHECK(search(objective, lagging_options(seed, lag)).simulations <= 60);
      most = std::max(most, objective.most_begun);
    }
    CHECK(most == static_cast<std::size_t>(lag) + 1);
  }
}

TEST_CASE("a lag of one costs few simulations, and no time where there are cores for it", "[campaign]") {
  const int seeds = 100;
  std::vector<std::vector<Cost>> costs;  // by lag and cores
  for (const int lag : {0, 1}) {
    costs.emplace_back();
    for (const int cores : {2, 4, 8}) {
      const Cost cost = costs.back().emplace_back(cost_of(lag, cores, seeds));
      UNSCOPED_INFO("lag " << lag << ", " << cores << " cores: " << cost.simulations << " simulations, " << cost.time
                           << " units of time");
      CHECK(cost.confirmed >= 0.95 * seeds);
    }
  }
  CHECK(costs[1][0].simulations == costs[1][2].simulations);  // cores change the time alone
  CHECK(costs[1][0].simulations < 1.1 * costs[0][0].simulations);
  CHECK(costs[1][0].time < 1.1 * costs[0][0].time);
  CHECK(costs[1][1].time < costs[0][1].time);
  CHECK(costs[1][2].time < costs[0][2].time);
}
