#include "calibrate/search/search.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "fake_slump.h"

using namespace pastefit;
using namespace pastefit::synthetic;

namespace {

constexpr int budget = 120;

SearchOptions options_of(std::uint64_t seed) {
  SearchOptions options = options_with(seed);
  options.budget_simulations = budget;
  options.max_pending = 3;
  return options;
}

CandidateResult result_of(Synthetic& slump, const Candidate& one) {
  const auto how = one.may_end_early ? &Synthetic::try_out : &Synthetic::evaluate;
  return {one.number, (slump.*how)({&one.point, 1}, {&one.packing, 1}).at(0).evaluations.at(0)};
}

/// Suggests up to so many at a time, and ingests one of those under way, drawn from `seed`; at most `most` answers.
void go_on(Search& search, Synthetic& slump, std::size_t workers, std::uint64_t seed, std::size_t most = 100'000) {
  std::vector<Candidate> under_way;
  for (std::size_t told = 0; told < most && !search.finished();) {
    const auto candidates = search.suggest(under_way.size() < workers ? workers - under_way.size() : 1);
    under_way.insert(under_way.end(), candidates.begin(), candidates.end());
    if (under_way.empty() || (!candidates.empty() && under_way.size() < workers)) continue;
    const auto chosen = under_way.begin() + static_cast<std::ptrdiff_t>(hash_of(seed, told) % under_way.size());
    const CandidateResult result = result_of(slump, *chosen);
    under_way.erase(chosen);
    search.ingest({&result, 1});
    ++told;
  }
}

void check_same(const Calibration& one, const Calibration& other) {
  CHECK(one.status == other.status);
  CHECK(one.reason == other.reason);
  CHECK(one.best.point == other.best.point);
  CHECK(one.best.misfit == other.best.misfit);
  CHECK(one.simulations == other.simulations);
  REQUIRE(one.history.size() == other.history.size());
  for (std::size_t k = 0; k < one.history.size(); ++k) {
    CHECK(one.history[k].point == other.history[k].point);
    CHECK(one.history[k].packings == other.history[k].packings);
  }
}

Calibration in_one_call(std::uint64_t seed) {
  Synthetic slump = fake_slump(150, seed);
  slump.budget = budget;
  return search(slump, options_of(seed));
}

}  // namespace

TEST_CASE("answers in any order, from any number of workers, lead to the same calibration", "[campaign]") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const Calibration expected = in_one_call(seed);
    for (const std::size_t workers : {1, 2, 4, 16}) {
      Synthetic slump = fake_slump(150, seed);
      Search asked(slump, options_of(seed), {.simulations = budget});
      go_on(asked, slump, workers, seed);
      check_same(asked.result(), expected);
    }
  }
}

TEST_CASE("a stop ends a search without another answer, with the best so far") {
  Synthetic slump = fake_slump(150, 3);
  Search asked(slump, options_of(3), {.simulations = budget});
  go_on(asked, slump, 2, 1, 10);
  asked.stop();
  while (!asked.finished()) (void)asked.suggest(1);
  CHECK(asked.result().status == CalibrationStatus::stopped);
  CHECK(asked.result().best.point.size() == 5);
}

TEST_CASE("a search that nobody answers can be left alone") {
  Synthetic slump = fake_slump(150, 3);
  Search asked(slump, options_of(3), {.simulations = budget});
  CHECK(asked.suggest(100).size() == static_cast<std::size_t>(options_of(3).screening));
  CHECK(asked.suggest(100).empty());
}

TEST_CASE("an answer to what was not suggested is refused, and to another point") {
  Synthetic slump = fake_slump(150, 3);
  Search asked(slump, options_of(3), {.simulations = budget});
  const auto candidates = asked.suggest(2);
  CandidateResult result = result_of(slump, candidates[0]);
  result.candidate = 1000;
  CHECK_THROWS_AS(asked.ingest({&result, 1}), std::logic_error);
  result.candidate = candidates[1].number;
  CHECK_THROWS_AS(asked.ingest({&result, 1}), std::logic_error);
}
