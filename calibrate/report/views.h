#pragma once

#include <functional>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/report/film.h"
#include "calibrate/report/looks.h"

namespace pastefit {

/// A test of a card, looked at while it is simulated with the card's material.
struct TestView {
  Film film;                  ///< of the first packing
  std::vector<SeenRun> runs;  ///< those that did not fail, in the order of their packings
  std::vector<std::string> failures;
};

/// A test of a card on so many of the packings that confirmed it, as it was seen before; what was not is simulated, one
/// on each processor, and looked at.
/// `goes_on` is asked between steps; once it answers false, what has not ended is left out.
/// `threads` 0: one for each processor.
TestView view_of(const CardTest& test, std::span<const std::uint64_t> packings, int threads,
                 const std::function<bool()>& goes_on, Looks* seen = nullptr);

}  // namespace pastefit
