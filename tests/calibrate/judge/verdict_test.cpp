#include "calibrate/judge/verdict.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace pastefit;

namespace {

/// Of so many heaps, whose readings meet the laboratory; how near they came to being rejected is not known.
Evidence heaps_with(int rejected, int heaps) {
  return {.heaps = heaps, .rejected = rejected};
}

}  // namespace

TEST_CASE("a material meets the laboratory, is refuted, or the noise hides which") {
  struct Case {
    double error, noise;
    Verdict verdict;
  };
  const Case cases[] = {
      {0, 0, Verdict::meets},          {1, 0, Verdict::meets},
      {1.002, 0, Verdict::refuted},    {0, 1, Verdict::meets},
      {0, 1.002, Verdict::undecided},  {0.6, 0.79, Verdict::meets},
      {0.6, 0.81, Verdict::undecided}, {0.996, 0.64, Verdict::undecided},
      {1.2, 0.6, Verdict::refuted},    {1.2, 0.8, Verdict::undecided},
      {2.602, 2.4, Verdict::refuted},  {2.598, 2.4, Verdict::undecided},
  };
  for (const Case& one : cases) {
    CAPTURE(one.error, one.noise);
    CHECK(verdict_on_readings({.error = one.error, .noise = one.noise}) == one.verdict);
  }
  CHECK(verdict_on({.whole = false}, 1) == Verdict::refuted);
}

TEST_CASE("heaps that a laboratory would reject are counted: few of many meet, many refute, few of few say nothing") {
  // P(p <= 0.2) of a beta distribution of k + 1 and n - k + 1 is that of more than k of n + 1 in a binomial one.
  CHECK(verdict_on(heaps_with(0, 4), 0.2) == Verdict::undecided);  // 0.67
  CHECK(verdict_on(heaps_with(0, 8), 0.2) == Verdict::meets);      // 0.87
  CHECK(verdict_on(heaps_with(1, 8), 0.2) == Verdict::undecided);  // 0.56
  CHECK(verdict_on(heaps_with(3, 8), 0.2) == Verdict::refuted);    // 0.09
  CHECK(verdict_on(heaps_with(1, 16), 0.2) == Verdict::meets);     // 0.88
  CHECK(verdict_on(heaps_with(2, 16), 0.2) == Verdict::undecided);
  CHECK(verdict_on(heaps_with(8, 8), 1) == Verdict::meets);
  Evidence off = heaps_with(0, 8);
  off.error = 2;
  CHECK(verdict_on(off, 0.2) == Verdict::refuted);
}

TEST_CASE("of materials that are not confirmed the one whose worst trouble is least comes nearest") {
  Evidence off = heaps_with(0, 8), sheared = heaps_with(6, 32);
  off.error = 1.9;
  sheared.error = 0.6;
  CHECK(shortfall(off, 0.2) == Approx(1.9));
  CHECK(shortfall(sheared, 0.2) == Approx(6.0 / 32 / 0.2));
  CHECK(shortfall(sheared, 0.1) == Approx(6.0 / 32 / 0.1));
  CHECK(shortfall(sheared, 1) == Approx(0.6));
  CHECK(shortfall(heaps_with(0, 8), 0) == 0);
  CHECK(std::isinf(shortfall(heaps_with(1, 8), 0)));
  off.whole = false;
  CHECK(std::isinf(shortfall(off, 0.2)));
}

TEST_CASE("eight heaps that all but sheared off do not do as eight that hardly shifted") {
  const auto heaps = [](double mean_root, double deviation) {
    Evidence out;
    for (int i = 0; i < 8; ++i) out.add_heap(std::pow(mean_root + (i % 2 == 0 ? deviation : -deviation), 2));
    return out;
  };
  CHECK(verdict_on(heaps(0.5, 0.15), 0.2) == Verdict::meets);
  CHECK(verdict_on(heaps(0.85, 0.14), 0.2) == Verdict::undecided);
  CHECK(verdict_on(heaps(0.85, 0.14), 1) == Verdict::meets);
}

TEST_CASE("one of eight heaps that sheared off does not hide that the others hardly shifted; two of them do") {
  const auto heaps = [](int sheared) {
    Evidence out;
    for (int i = 0; i < 8; ++i) out.add_heap(i < sheared ? 1.05 : i % 2 == 0 ? 0.2 : 0.4);
    return out;
  };
  CHECK(verdict_on(heaps(1), 0.2) == Verdict::meets);
  CHECK(verdict_on(heaps(2), 0.2) == Verdict::undecided);
}

TEST_CASE("the one heap that stands among many confirms nothing, whatever share may be rejected") {
  CHECK(verdict_on(heaps_with(7, 8), 1) == Verdict::undecided);
  CHECK(verdict_on(heaps_with(6, 8), 1) == Verdict::meets);
}
