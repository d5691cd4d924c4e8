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

}  // namespace pastefit
