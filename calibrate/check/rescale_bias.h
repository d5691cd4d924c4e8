#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/check/check.h"

namespace pastefit {

/// Measures the effect of another grain size on a card's readings: simulates `before` and `after` (`rescaled(before)`)
/// in `packings` random packings each. Returns `after` with new readings, confirmation and baseline, and with the bias
/// of every reading and its standard error. Requirement: packings >= 2. Errors: a simulation fails.
Result<Card> with_measured_bias(const Card& before, Card after, int packings, const CheckOptions& options,
                                const CheckEngine& engine = CheckEngine::ours());

/// Readings of another engine in a card's test, packing by packing, and their cost.
struct EngineRuns {
  std::string engine, program;      ///< as in `FurtherConfirmation`
  std::vector<Baseline::Run> runs;  ///< the same readings in every run
  int ranks = 1;
  double wall_s = 0, core_s = 0;
};

/// Compares these runs with the card's own confirmation. `test`: of the card; `simulated`: the same as simulated by the
/// other engine, possibly with other grains. Requirement: at least one run. The bias of a reading is the other mean
/// less the card's, over accepted heaps; its standard error is sqrt(s^2/n + s_card^2/n_card). `confirmation_by` judges
/// readings and heaps; an interpolated material, and a test without fitted reading, never meets the laboratory.
FurtherConfirmation further_confirmation(const Card& card, const CardTest& test, const Test& simulated,
                                         const EngineRuns& runs);

}  // namespace pastefit
