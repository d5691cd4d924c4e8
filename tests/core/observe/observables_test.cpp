#include "core/observe/observables.h"

#include <catch2/catch.hpp>

using namespace pastefit;

TEST_CASE("a reading that one of several runs lacks has no mean") {
  Observables first, second;
  first.set("step2.spilled_share", 0.5);
  first.set("step2.height_mm", 100);
  second.set("step2.spilled_share", 1);
  const Observables mean = mean_of({first, second});
  CHECK(mean.find("step2.spilled_share") == 0.75);
  CHECK_FALSE(mean.find("step2.height_mm"));
  CHECK(mean_of({}).all().empty());
}
