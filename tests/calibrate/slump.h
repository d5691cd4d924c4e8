#pragma once

#include <utility>

#include "calibrate/laboratory/test.h"

namespace pastefit {

/// A function of slump tests in the engine's place.
template <class Run>
auto of_slump(Run run) {
  return [run = std::move(run)](const Test& test, const RunOptions& options) {
    return run(std::get<SlumpTest>(test), options);
  };
}

}  // namespace pastefit
