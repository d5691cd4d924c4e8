#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/report/findings.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// The findings as one HTML file that needs nothing else: the page of `calibrate/report/page`, which is part of this
/// program, with their content (`page_content`) and films in it. Texts of others cannot become markup of it.
std::string page_of(const Findings& findings, const std::string& command);

inline const std::string kPage = "report.html";

/// Where the looks at a card's tests come from.
struct LookOptions {
  int threads = 0;
  bool simulate = true;  ///< what was neither seen nor kept
  RunRecordings* seen = nullptr;
  std::function<void(const std::string&)> tell = {};  ///< why something takes time, in words; may be left empty
};

/// Shows the card's tests on the packings that confirmed it, the first sixteen at most: as they were seen, or as the
/// folder has kept them (`kViewsFile`); what is neither is simulated, until `stop` becomes true, and then kept. What
/// could not be shown is missing in the findings. Errors: what was seen could not be kept.
Faults look_at_tests(Findings& findings, const std::filesystem::path& folder, const std::atomic<bool>& stop,
                     const LookOptions& options);

/// The page of a calibration that goes on, written anew every now and then.
class LivePage {
 public:
  explicit LivePage(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// To be called often; that it cannot be written is no fault of the calibration.
  void show(const Study& study, const Store& store);

 private:
  std::filesystem::path folder_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::seconds(5);
};

/// Writes the curve of each test that draws one and whose runs were all seen (`curve_csv`) into a result folder; adds
/// the names of the files to `written`. Errors: the folder cannot be written.
Faults write_curves(const std::filesystem::path& folder, const Findings& findings, std::vector<std::string>& written);

/// Writes the page of a result folder into it. Errors: the folder cannot be written.
Faults write_page(const std::filesystem::path& folder, const Findings& findings);

inline const std::string kSummary = "summary.txt";

/// Opens the folder of a calibration, with room for every evaluation. With `force` the files of an earlier one are
/// removed. Errors: those of `OutputFolder::open`; an earlier result, without `resume` and `force`.
Result<OutputFolder> open_calibration_folder(const std::filesystem::path& folder, const Study& study, bool resume,
                                             bool force);

/// Writes the card and its summary. Errors: the folder cannot be written.
Faults write_card(const OutputFolder& folder, const Card& card, const std::string& summary);

/// Writes the page and the curves of a calibration that has a card, its tests as `look_at_tests` shows them; adds the
/// names of the curves to `files`. Errors: the folder cannot be written.
Faults write_looks(const OutputFolder& folder, Findings findings, const std::atomic<bool>& stop,
                   const LookOptions& options, std::vector<std::string>& files);

}  // namespace pastefit
