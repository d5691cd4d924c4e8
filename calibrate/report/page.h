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

/// Self-contained HTML file of the findings: the page of `calibrate/report/page`, which is embedded in the program,
/// with `page_content` and films. Input texts are escaped.
std::string page_of(const Findings& findings, const std::string& command);

inline const std::string kPage = "report.html";

struct LookOptions {
  int threads = 0;
  bool simulate = true;  ///< simulate what is neither seen nor kept
  RunRecordings* seen = nullptr;
  std::function<void(const std::string&)> tell = {};  ///< receives the reason for a delay; may be empty
};

/// Provides views of the card's tests on its confirmation packings, at most the first sixteen: from `seen`, else from
/// the folder (`kViewsFile`), else by simulation until `stop` becomes true. Simulated views are saved. What could not
/// be shown is listed in `findings.missing`. Errors: a view cannot be saved.
Faults look_at_tests(Findings& findings, const std::filesystem::path& folder, const std::atomic<bool>& stop,
                     const LookOptions& options);

/// Page of a running calibration, rewritten at intervals.
class LivePage {
 public:
  explicit LivePage(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Call this often. Write errors do not affect the calibration.
  void show(const Study& study, const Store& store);

 private:
  std::filesystem::path folder_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::seconds(5);
};

/// Writes the curves (`curve_csv`) of tests whose runs were all seen into a result folder; appends the file names to
/// `written`. Errors: the folder cannot be written.
Faults write_curves(const std::filesystem::path& folder, const Findings& findings, std::vector<std::string>& written);

/// Writes the page into a result folder. Errors: the folder cannot be written.
Faults write_page(const std::filesystem::path& folder, const Findings& findings);

inline const std::string kSummary = "summary.txt";

/// Opens the folder of a calibration and reserves space for every evaluation. `force` removes the files of an earlier
/// calibration. Errors: those of `OutputFolder::open`; an earlier result, without `resume` and `force`.
Result<OutputFolder> open_calibration_folder(const std::filesystem::path& folder, const Study& study, bool resume,
                                             bool force);

/// Writes the card and its summary. Errors: the folder cannot be written.
Faults write_card(const OutputFolder& folder, const Card& card, const std::string& summary);

/// Writes page and curves of a calibration with a card, with views from `look_at_tests`; appends the names of the
/// curves to `files`. Errors: the folder cannot be written.
Faults write_looks(const OutputFolder& folder, Findings findings, const std::atomic<bool>& stop,
                   const LookOptions& options, std::vector<std::string>& files);

}  // namespace pastefit
