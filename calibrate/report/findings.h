#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/inference/inference.h"
#include "calibrate/report/views.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Contents of a result folder; every part may be missing.
struct Findings {
  std::optional<Card> card;
  std::optional<Study> study;                 ///< of the card, or of the running calibration
  bool under_way = false;                     ///< the calibration is running: the page reloads itself
  std::vector<StoredEvaluation> evaluations;  ///< in the order of arrival
  std::string program;                        ///< that made the evaluations; may be empty
  std::optional<TrainingData> evidence;       ///< training data from the evaluations
  std::optional<Inference> inference;         ///< of the parameters from that evidence
  std::vector<TestView> views;                ///< one per test of the card; empty if not simulated
  std::vector<std::string> missing;           ///< missing or damaged parts: one sentence each
};

/// Results of a calibration that is running, or that ended without a card.
Findings findings_without_card(const Study& study, const Store& store);

/// Results of a completed calibration. `inference`: its own; if absent, it is computed.
Findings findings_of(const Card& card, const Store& store, const std::optional<Inference>& inference);

Inference inference_of(const Card& card, const TrainingData& evidence);

inline const std::string kCardFile = "card.json";

/// A calibrated material and those that fit its readings as well, the card's own first.
struct FittingMaterials {
  Card card;
  std::vector<std::vector<double>> values;  ///< of each material, of `parameter_kinds()`
};

/// Reads them from a folder written by `pastefit calibrate`. Error: there are none.
Result<FittingMaterials> read_fitting_materials(const std::filesystem::path& folder);

/// Reads a folder written by `pastefit calibrate`. Missing and damaged parts are listed in `missing`. Error: no such
/// folder, or neither card nor evaluations in it.
Result<Findings> read_findings(const std::filesystem::path& folder);

}  // namespace pastefit
