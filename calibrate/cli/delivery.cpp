#include "calibrate/cli/delivery.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/cli/commands.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/inference/description.h"
#include "calibrate/report/calibration_folder.h"
#include "calibrate/report/summary.h"

namespace pastefit {

namespace {

/// The answer as JSON where there is no card to print.
nlohmann::ordered_json without_material(const CalibrationResult& result) {
  auto failures = nlohmann::ordered_json::object();
  for (const auto& [reason, count] : result.counts.failures) failures[std::string(name_of(reason))] = count;
  return {{"status", name_of(result.search.status)},
          {"reason", result.search.reason},
          {"simulations", result.search.simulations},
          {"failures", failures}};
}

}  // namespace

int Delivery::deliver(const CalibrationResult& result, const std::atomic<bool>& stop, RunRecordings& seen) const {
  return result.card ? deliver_card(*result.card, result.inference, stop, seen) : say_why_not(result);
}

int Delivery::deliver_card(const Card& card, const std::optional<Inference>& inference, const std::atomic<bool>& stop,
                           RunRecordings& seen) const {
  const auto summary = summary_of(card, inference ? describe(*inference) : "");
  auto faults = write_card(folder, card, summary);
  print("%s", json ? json_text(to_json(card)).c_str() : summary.c_str());
  std::vector<std::string> files{kCardFile, kSummary, kPage, kStore};
  if (faults.empty())
    faults = write_looks(folder, findings_of(card, store, inference), stop, {.threads = threads, .seen = &seen}, files);
  if (!faults.empty()) return report(faults, kFailed);
  for (const std::string& name : files) note("wrote %s\n", folder.file(name).c_str());
  return card.search.status == name_of(CalibrationStatus::confirmed) ? kDone : kFailed;
}

int Delivery::say_why_not(const CalibrationResult& result) const {
  std::fprintf(stderr, "pastefit: no material to report: %s\n", result.search.reason.c_str());
  for (const auto& [reason, count] : result.counts.failures)
    std::fprintf(stderr, "  %d simulations failed: %s\n", count, std::string(name_of(reason)).c_str());
  std::fprintf(stderr, "The evaluations are kept in %s.\n", folder.file(kStore).c_str());
  if (json) print("%s", json_text(without_material(result)).c_str());
  (void)write_page(folder.path(), findings_without_card(study, store));
  return kFailed;
}

}  // namespace pastefit
