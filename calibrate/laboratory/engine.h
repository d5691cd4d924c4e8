#pragma once

#include <functional>
#include <memory>

#include "calibrate/laboratory/test.h"

namespace pastefit {

/// What is asked of the engine, by a search as by a check. A test may put a quick or a spoiled one in its place.
struct Engine {
  std::function<std::shared_ptr<const Packing>(const Test&, const RunOptions&)> prepare =
      [](const Test& test, const RunOptions& options) { return pastefit::prepare(test, options); };
  std::function<Outcome(const Test&, const RunOptions&)> run = [](const Test& test, const RunOptions& options) {
    return simulate(test, options);
  };
};

}  // namespace pastefit
