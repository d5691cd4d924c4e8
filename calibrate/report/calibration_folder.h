#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/report/findings.h"
#include "calibrate/report/report_page.h"
#include "calibrate/store/output_folder.h"
#include "calibrate/study/study.h"

namespace pastefit {

inline const std::string kSummary = "summary.txt";

/// The files of a calibration's folder, those of an earlier one included.
std::vector<std::string> calibration_files(const Study& study);

/// Writes the card and its summary. Errors: the folder cannot be written.
Faults write_card(const OutputFolder& folder, const Card& card, const std::string& summary);

/// Writes the page and the curves of a calibration that has a card, its tests as `look_at_tests` shows them; adds the
/// names of the curves to `files`. Errors: the folder cannot be written.
Faults write_looks(const OutputFolder& folder, Findings findings, const std::atomic<bool>& stop,
                   const LookOptions& options, std::vector<std::string>& files);

}  // namespace pastefit
