#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/check/check.h"

namespace pastefit {

/// Measures what carrying a card to another grain size does to its readings: `before` and `after` (`rescaled(before)`)
/// are both simulated in `packings` random packings each. The answer is `after` with the bias of every reading and its
/// standard error, with readings, confirmation and baseline of its own.
/// Requirement: packings >= 2. Errors: a simulation fails.
Result<Card> with_measured_bias(const Card& before, Card after, int packings, const CheckOptions& options,
                                const CheckEngine& engine = CheckEngine::ours());

/// What another engine read of a card's test, packing by packing, and what that cost.
struct EngineRuns {
  std::string engine, program;      ///< as in `FurtherConfirmation`
  std::vector<Baseline::Run> runs;  ///< the same readings in every run
  int ranks = 1;
  double wall_s = 0, core_s = 0;
};

/// The runs beside the card's own confirmation. `test` is the card's; `simulated` the same as it ran there, maybe with
/// other grains. The bias of a reading is the mean there less the card's, over heaps that a laboratory would accept;
/// its standard error sqrt(s^2/n + s_card^2/n_card). Whether the material meets the laboratory is judged by
/// `confirmation_by`, readings and heaps; an interpolated one, and a test of which nothing is fitted, never does.
/// Requirement: one run at least.
FurtherConfirmation further_confirmation(const Card& card, const CardTest& test, const Test& simulated,
                                         const EngineRuns& runs);

}  // namespace pastefit
