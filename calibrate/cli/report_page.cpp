#include "calibrate/cli/report_page.h"

#include <algorithm>

#include "calibrate/base/atomic_file.h"
#include "calibrate/report/page.h"

namespace pastefit {

void look_at_tests(Findings& findings, int threads, const std::atomic<bool>& stop, Looks* seen) {
  constexpr std::size_t kMostPackings = 8;
  if (!findings.card) return;
  if (stop) {
    findings.missing.push_back("The tests were not simulated for this page, because the run was interrupted.");
    return;
  }
  const auto& packings = findings.card->confirmation.packings;
  const std::span shown(packings.data(), std::min(packings.size(), kMostPackings));
  if (packings.size() > shown.size())
    findings.missing.push_back("The drawings show " + std::to_string(shown.size()) + " of the " +
                               std::to_string(packings.size()) + " packings that the readings are means over.");
  for (const CardTest& test : findings.card->tests) {
    findings.views.push_back(view_of(
        test, shown, threads, [&] { return !stop; }, seen));
    if (stop) findings.missing.push_back("The run was interrupted while the tests were simulated for this page.");
    for (const std::string& failure : findings.views.back().failures)
      findings.missing.push_back(heading_of(test) + "a run that should be shown failed, " + failure);
  }
}

void LivePage::show(const Study& study, const Store& store) {
  constexpr std::chrono::seconds kInterval{15};
  if (std::chrono::steady_clock::now() < next_) return;
  (void)write_page(folder_, findings_under_way(study, store));
  next_ = std::chrono::steady_clock::now() + kInterval;
}

Faults write_page(const std::filesystem::path& folder, const Findings& findings) {
  return write_atomically(folder / kPage, page_of(findings, "pastefit report " + folder.string()));
}

}  // namespace pastefit
