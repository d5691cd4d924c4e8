#include "calibrate/report/report_page.h"

#include <algorithm>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/report/curve_csv.h"
#include "calibrate/report/kept_views.h"
#include "calibrate/report/page.h"

namespace pastefit {

Faults look_at_tests(Findings& findings, const std::filesystem::path& folder, const std::atomic<bool>& stop,
                     const LookOptions& options) {
  constexpr std::size_t kMostPackings = 16;
  if (!findings.card) return {};
  const Card& card = *findings.card;
  const auto& packings = card.confirmation.packings;
  const std::span shown(packings.data(), std::min(packings.size(), kMostPackings));
  if (packings.size() > shown.size())
    findings.missing.push_back("The drawings show " + std::to_string(shown.size()) + " of the " +
                               std::to_string(packings.size()) + " packings that the readings are means over.");
  const auto kept = read_views(folder / kViewsFile, card, shown);
  const Fault why = kept.ok() ? Fault{} : kept.faults().front();  // not read
  if (kept.ok()) {
    findings.views = kept.value();
  } else {
    if (options.simulate && !options.seen && options.tell)
      options.tell(why.where + " " + why.what + ": the tests are simulated anew");
    const auto goes_on = [&] { return options.simulate && !stop; };
    for (const CardTest& test : card.tests)
      findings.views.push_back(view_of(test, shown, options.threads, goes_on, options.seen));
  }
  std::size_t lacking = 0;
  for (std::size_t i = 0; i < findings.views.size(); ++i) {
    lacking += findings.views[i].lacking;
    for (const std::string& failure : findings.views[i].failures)
      findings.missing.push_back(heading_of(card.tests[i]) + "a run that should be shown failed, " + failure);
  }
  if (lacking > 0) {
    findings.missing.push_back("Film and heaps of " + std::to_string(lacking) + " of " +
                               std::to_string(shown.size() * card.tests.size()) + " runs are not shown: " + why.where +
                               " " + why.what + ", and they were not simulated anew" +
                               (stop ? ", because the run was interrupted." : "."));
    return {};
  }
  return kept.ok() ? Faults{} : write_views(folder / kViewsFile, card, shown, findings.views);
}

void LivePage::show(const Study& study, const Store& store) {
  constexpr std::chrono::seconds kInterval{15};
  if (std::chrono::steady_clock::now() < next_) return;
  (void)write_page(folder_, findings_under_way(study, store));
  next_ = std::chrono::steady_clock::now() + kInterval;
}

Faults write_curves(const std::filesystem::path& folder, const Findings& findings, std::vector<std::string>& written) {
  for (std::size_t i = 0; i < findings.views.size(); ++i) {
    const CardTest& test = findings.card->tests[i];
    const auto curve = curve_csv(test, findings.views[i]);
    if (!curve || findings.views[i].lacking > 0) continue;  // some of the runs alone would be other means
    written.push_back(curve_file(test.name));
    if (auto faults = write_atomically(folder / written.back(), *curve); !faults.empty()) return faults;
  }
  return {};
}

Faults write_page(const std::filesystem::path& folder, const Findings& findings) {
  return write_atomically(folder / kPage,
                          page_of(findings, "pastefit report " + shell_word_if_needed(folder.string())));
}

}  // namespace pastefit
