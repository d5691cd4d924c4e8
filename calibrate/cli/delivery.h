#pragma once

#include <atomic>

#include "calibrate/calibrate.h"
#include "calibrate/report/findings.h"
#include "calibrate/store/output_folder.h"

namespace pastefit {

/// What a calibration brought, to its folder and to the person: card, summary, curves and page; without a card the page
/// alone, and why there is none. Who interrupts gets the page with what was seen until then.
struct Delivery {
  const Study& study;
  const Store& store;
  const OutputFolder& folder;
  int threads = 0;    ///< to simulate what is to be shown and was not seen
  bool json = false;  ///< print the card instead of the summary

  /// The program's exit status: only a confirmed material is what was asked for.
  int deliver(const CalibrationResult& result, const std::atomic<bool>& stop, RunRecordings& seen) const;

 private:
  int deliver_card(const Card& card, const std::optional<Inference>& inference, const std::atomic<bool>& stop,
                   RunRecordings& seen) const;
  int say_why_not(const CalibrationResult& result) const;
};

}  // namespace pastefit
