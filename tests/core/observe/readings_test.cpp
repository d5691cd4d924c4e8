#include "core/observe/readings.h"

#include <catch2/catch.hpp>

using namespace pastefit;

TEST_CASE("a reading that one of several runs lacks has no mean") {
  Readings first, second;
  first.set("step2.spilled_share", 0.5);
  first.set("step2.height_mm", 100);
  second.set("step2.spilled_share", 1);
  const Readings mean = mean_of({first, second});
  CHECK(mean.find("step2.spilled_share") == 0.75);
  CHECK_FALSE(mean.find("step2.height_mm"));
  CHECK(mean_of({}).all().empty());
}
