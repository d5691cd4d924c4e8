#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// Summary of a card: fitted parameters in SI and scale-free, measured against simulated readings, course of the
/// search, and the verdict. `findings`: text on the parameters (`calibrate/inference/description.h`), in whole lines;
/// may be empty.
std::string summary_of(const Card& card, const std::string& findings = {});

/// Sentence whether the material meets the measurements.
std::string verdict_of(const Card& card);

/// Complete text of a card: summary, undetermined parameters, conditions of the fit, provenance, baseline, changes
/// since then, and results of other engines.
std::string text_of(const Card& card);

/// Result of another engine for a test of the card: cost, bias of each reading, and verdict.
std::string further_confirmation_text(const FurtherConfirmation& confirmation);

/// Measurements of a test, in the order of its readings.
std::vector<Measurement> laboratory_measurements(const CardTest& test);

/// Remarks on the runs of a test (`laboratory/test.h`); may be empty.
std::string remarks_on(const CardTest& test);

/// Whether a held-out test was predicted. Requirement: it was judged.
std::string hold_out_in_words(const CardTest& test);

/// Reservations about a card whose readings may be within their tolerances, one text each, the most serious first:
/// those of all `diagnoses_of`. May be empty.
std::vector<std::string> reservations_on(const Card& card);

/// Value for manual input into a DEM program.
struct TypeInRow {
  std::string quantity;  ///< in the terms of DEM manuals, e.g. "sliding friction"
  double value = 0;      ///< in `unit`
  std::string unit;      ///< "" for ratios
  std::string remark;    ///< advice; mostly empty
};

/// Values of one pair of surfaces, of the grains, or of the attraction.
struct TypeInGroup {
  std::string title;  ///< e.g. "Grain on grain: Hertz-Mindlin, rolling by spring and dashpot"
  std::vector<TypeInRow> rows;
};

/// All values of a card's material that another DEM program needs, in SI with customary prefixes: grains and their
/// density (which gives the measured bulk density in a filled mould), each pair of surfaces of the tests, and the
/// attraction for grains of the card's size. Surfaces of several tests are listed once.
std::vector<TypeInGroup> type_in_table(const Card& card);

/// Viscous force for every pair of surfaces as lines: formula, then each symbol.
std::vector<std::string> damping_law(NormalLaw law);

/// At most five digits: "0.3", not "0.30000".
std::string typed(double value);

/// The table as lines for a terminal of 80 columns.
std::string type_in_lines(const Card& card);

struct CardFile {
  std::string name;
  Card card;
};

/// Table of cards for a terminal of 80 columns: verdicts, differing parameters, and readings. Last column: largest over
/// smallest value of a parameter, largest difference of a reading. A value is marked if another card's interval of that
/// parameter excludes it; these two measurements disagree. Unmarked values may differ because of missing information
/// only. Requirement: at least two cards.
std::string comparison_lines(std::span<const CardFile> cards);

/// The comparison as JSON: `cards`, `parameters` and `readings`; null for missing values.
nlohmann::ordered_json comparison_json(std::span<const CardFile> cards);

}  // namespace pastefit
