#include "calibrate/report/calibration_folder.h"

#include "calibrate/base/atomic_file.h"
#include "calibrate/card/card.h"
#include "calibrate/report/curve_csv.h"
#include "calibrate/report/kept_views.h"

namespace pastefit {

std::vector<std::string> calibration_files(const Study& study) {
  std::vector<std::string> files{kCardFile, kSummary, kPage, kViewsFile};
  for (const StudyTest& test : study.tests) files.push_back(curve_file(test.name));
  return with_store(std::move(files));
}

Faults write_card(const OutputFolder& folder, const Card& card, const std::string& summary) {
  auto faults = write_card(folder.file(kCardFile), card);
  return faults.empty() ? write_atomically(folder.file(kSummary), summary) : faults;
}

Faults write_looks(const OutputFolder& folder, Findings findings, const std::atomic<bool>& stop,
                   const LookOptions& options, std::vector<std::string>& files) {
  auto faults = look_at_tests(findings, folder.path(), stop, options);
  if (faults.empty()) faults = write_curves(folder.path(), findings, files);
  return faults.empty() ? write_page(folder.path(), findings) : faults;
}

}  // namespace pastefit
