#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/report/recording_code.h"
#include "calibrate/report/run_recording.h"

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

inline const std::string kViewsFile = "views.json";

/// Keeps what is shown of a card's tests on these packings, so that its page needs no simulation:
///     {"format", "checksum", "program", "tests": [{"simulations": [...], "film": {"index", "grains"},
///      "runs": [{"packing", "readings", "outlines", "curve"}], "failures": [...]}]};
/// simulations: the name (`evaluation_key`) of each packing's, also of those that failed; checksum: of all the rest.
/// Requirement: a view for each test, and none lacks anything.
/// Errors: the file cannot be written.
Faults write_views(const std::filesystem::path& file, const Card& card, std::span<const std::uint64_t> packings,
                   const std::vector<TestView>& views);

/// The views of the card's tests on these packings, as they were kept, whichever program simulated them.
/// Errors: there is no such file, it is larger than 16 MB, damaged, or of another material, other tests or other
/// packings.
Result<std::vector<TestView>> read_views(const std::filesystem::path& file, const Card& card,
                                         std::span<const std::uint64_t> packings);

/// What a test draws (`Curve`), over the runs of its view, as CSV: one line for each point, below the names of the
/// columns. These are the curve's own x and y, y the mean over the runs; the lowest and the highest of them; and each
/// reading that the laboratory took in the unit of y, e.g. a strength in Pa beside a stress, with its standard
/// deviation, the same in every line. Nothing where no run has a curve.
std::optional<std::string> curve_csv(const CardTest& test, const TestView& view);

/// Its file in a calibration's folder: curve.csv, or curve-NAME.csv of a test that has a name.
std::string curve_file(const std::string& test_name);

}  // namespace pastefit
