#include "calibrate/report/page.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/report/page_content.h"
#include "calibrate/report/views.h"

// The page as built by esbuild, between two symbols. Assembler embeds the file: a source of its bytes would be five
// times as large and take a second to compile. Symbols of WebAssembly have a size.
#ifdef __wasm__
#define PASTEFIT_CONSTANTS ".section .rodata.page,\"\",@\n"
#define PASTEFIT_BACK ".text\n"
#else
#define PASTEFIT_CONSTANTS ".section .rodata\n"
#define PASTEFIT_BACK ".previous\n"
#endif
asm(PASTEFIT_CONSTANTS R"(
  .globl pastefit_page_begin
pastefit_page_begin:
  .incbin ")" PASTEFIT_PAGE_FILE R"("
  .size pastefit_page_begin, .-pastefit_page_begin
  .globl pastefit_page_end
pastefit_page_end:
  .byte 0
  .size pastefit_page_end, 1
)" PASTEFIT_BACK);
extern "C" const char pastefit_page_begin[], pastefit_page_end[];

namespace pastefit {

std::string page_of(const Findings& findings, const std::string& command) {
  constexpr std::string_view kPlace = "<!--content-->";
  const std::string_view page(pastefit_page_begin, static_cast<std::size_t>(pastefit_page_end - pastefit_page_begin));
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos) throw std::logic_error("the page has no place for its content");
  std::string out(page.substr(0, place));
  out += "<script type=\"application/json\" id=\"content\">" + json_in_html(page_content(findings, command)) +
         "</script>\n";
  for (std::size_t i = 0; i < findings.views.size(); ++i)
    if (const CodedRecording& film = findings.views[i].film; !film.empty())
      out += "<script type=\"text/plain\" id=\"film-" + std::to_string(i) + "\">" + film.grains + "</script>\n";
  out += page.substr(place + kPlace.size());
  return out;
}

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
  const Fault why = kept.ok() ? Fault{} : kept.faults().front();  // reason why it was not read
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
  Findings findings = findings_without_card(study, store);
  findings.under_way = true;
  (void)write_page(folder_, findings);
  next_ = std::chrono::steady_clock::now() + kInterval;
}

Faults write_curves(const std::filesystem::path& folder, const Findings& findings, std::vector<std::string>& written) {
  for (std::size_t i = 0; i < findings.views.size(); ++i) {
    const CardTest& test = findings.card->tests[i];
    const auto curve = curve_csv(test, findings.views[i]);
    if (!curve || findings.views[i].lacking > 0) continue;  // some of the runs would give other means
    written.push_back(curve_file(test.name));
    if (auto faults = write_atomically(folder / written.back(), *curve); !faults.empty()) return faults;
  }
  return {};
}

Faults write_page(const std::filesystem::path& folder, const Findings& findings) {
  return write_atomically(folder / kPage,
                          page_of(findings, "pastefit report " + shell_word_if_needed(folder.string())));
}

Result<OutputFolder> open_calibration_folder(const std::filesystem::path& folder, const Study& study, bool resume,
                                             bool force) {
  constexpr std::uintmax_t kSpaceOfEvaluation = 8u << 10;  // its row, twice: in log and table
  std::vector<std::string> files{kCardFile, kSummary, kPage, kViewsFile};
  for (const StudyTest& test : study.tests) files.push_back(curve_file(test.name));
  files = with_store(std::move(files));
  const auto earlier = force ? EarlierResult::replace : resume ? EarlierResult::resume : EarlierResult::refuse;
  const auto budget = static_cast<std::uintmax_t>(study.search.budget_simulations);
  auto opened = OutputFolder::open(folder, files, earlier, kSpace + budget * kSpaceOfEvaluation);
  if (opened.ok() && force) opened.value().clear(files);
  return opened;
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
