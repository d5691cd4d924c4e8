#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/report/run_recording.h"

namespace pastefit {

/// View of a test simulated with the card's material.
struct TestView {
  std::string program;        ///< that simulated it
  CodedRecording film;        ///< of the first packing
  std::vector<SeenRun> runs;  ///< without failed ones, ordered by packing
  std::vector<std::string> failures;
  std::size_t lacking = 0;  ///< packings without a complete run
};

/// View of a test on these confirmation packings. Uses `seen`; other packings are simulated in parallel. `goes_on` is
/// called before and between steps; after it returns false, nothing more is simulated, and incomplete runs count as
/// lacking. `threads` 0: one per processor.
TestView view_of(const CardTest& test, std::span<const std::uint64_t> packings, int threads,
                 const std::function<bool()>& goes_on, RunRecordings* seen = nullptr);

inline const std::string kViewsFile = "views.json";

/// Saves views of a card's tests on these packings, so that its page needs no simulation:
///     {"format", "checksum", "program", "tests": [{"simulations": [...], "film": {"index", "grains"},
///      "runs": [{"packing", "readings", "outlines", "curve"}], "failures": [...]}]};
/// simulations: `evaluation_key` of each packing, also of failed ones; checksum: of everything else. Requirement: a
/// complete view of each test. Errors: the file cannot be written.
Faults write_views(const std::filesystem::path& file, const Card& card, std::span<const std::uint64_t> packings,
                   const std::vector<TestView>& views);

/// Reads saved views of the card's tests on these packings, from any program version. Errors: no such file; it is
/// larger than 16 MB, damaged, or for another material, other tests or other packings.
Result<std::vector<TestView>> read_views(const std::filesystem::path& file, const Card& card,
                                         std::span<const std::uint64_t> packings);

/// Curve of a test (`Curve`) over the runs of its view, as CSV: a header and one line per point. Columns: x, mean of y
/// over the runs, lowest and highest y; then, constant, each measured reading in the unit of y, e.g. a strength in Pa
/// beside a stress, with its standard deviation. Nothing if no run has a curve.
std::optional<std::string> curve_csv(const CardTest& test, const TestView& view);

/// File name of the curve: curve.csv, or curve-NAME.csv for a test with a name.
std::string curve_file(const std::string& test_name);

}  // namespace pastefit
