#pragma once

#include <functional>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/report/recording_code.h"
#include "calibrate/report/run_recordings.h"

namespace pastefit {

/// A test of a card, looked at while it is simulated with the card's material.
struct TestView {
  std::string program;        ///< that simulated it
  CodedRecording film;        ///< of the first packing
  std::vector<SeenRun> runs;  ///< those that did not fail, in the order of their packings
  std::vector<std::string> failures;
  std::size_t lacking = 0;  ///< packings that were not looked at to their end
};

/// A test of a card on so many of the packings that confirmed it, as it was seen before; what was not is simulated, one
/// on each processor, and looked at.
/// `goes_on` is asked before and between steps; once it answers false, nothing more is simulated, and what has not
/// ended is lacking.
/// `threads` 0: one for each processor.
TestView view_of(const CardTest& test, std::span<const std::uint64_t> packings, int threads,
                 const std::function<bool()>& goes_on, RunRecordings* seen = nullptr);

}  // namespace pastefit
