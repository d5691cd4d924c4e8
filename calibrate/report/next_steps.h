#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// Command after a calibration without a confirmed material.
struct NextStep {
  std::string why;      ///< what it does, as the beginning of a sentence
  std::string command;  ///< ready to run
};

/// What to try after a calibration that ended with this card; empty if it is confirmed. `calibrate`: its command
/// without --resume, --force and --budget, to which the steps add their options. `out`: its folder. The first step
/// addresses what is in the way (`what_to_try`): bounds are widened within the admissible and the plausible range
/// (`plausible_ranges`). The last one is `pastefit doctor`.
std::vector<NextStep> next_steps(const Card& card, const std::string& calibrate, std::string_view out);

/// The same if no candidate could be simulated: `status` of the search, `study`: its file.
std::vector<NextStep> next_steps_without_card(std::string_view status, const std::string& calibrate,
                                              std::string_view study);

/// The reading and the bound in the way, then the commands, each on a line of its own that is not broken. Empty without
/// steps.
std::string next_step_lines(const std::string& in_the_way, const std::vector<NextStep>& steps);

/// "step1.height_mm is off by 12 mm, 7.5 mm allowed; friction 0.3 is at its upper bound": the cause of an unconfirmed
/// card, and its parameters at bounds.
std::string in_the_way(const Card& card);

}  // namespace pastefit
