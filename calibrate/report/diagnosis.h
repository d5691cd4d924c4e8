#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/store/store.h"

namespace pastefit {

/// A property of a calibration's result that may give reason for doubt. Texts are clauses without a full stop.
struct Diagnosis {
  std::string_view name;                       ///< e.g. "parameters at bounds"
  std::vector<std::string> reservations = {};  ///< with numbers; the summary lists them under this name
  std::vector<std::string> notes = {};         ///< with numbers; the summary states them elsewhere, or not at all
  std::string numbers = {};                    ///< of a property without doubt
  std::string unknown = {};                    ///< why nothing is known of it; empty: it is known
  std::string_view may_be_ignored;             ///< when its reservations and notes may be
  std::string_view page;                       ///< of the manual, e.g. "result.md#tolerances"

  bool is_doubtful() const { return !reservations.empty() || !notes.empty(); }
};

/// Every property of a card, the most serious first. `evaluations`: all stored simulations of its calibration; empty if
/// they are not at hand. Nothing is simulated.
std::vector<Diagnosis> diagnoses_of(const Card& card, std::span<const StoredEvaluation> evaluations = {});

/// One paragraph for each: its name, then "fine", or what is doubtful, when that may be ignored, and where the manual
/// explains it.
std::string diagnosis_lines(std::span<const Diagnosis> diagnoses);

/// The same as a list of {"name", "state", "found", "numbers", "may_be_ignored", "page"}; state: "fine", "doubtful" or
/// "unknown".
nlohmann::ordered_json diagnosis_json(std::span<const Diagnosis> diagnoses);

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
