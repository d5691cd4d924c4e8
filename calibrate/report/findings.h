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

/// What a result folder tells of a calibration, each part by itself, and what it lacks.
struct Findings {
  std::optional<Card> card;
  std::optional<Study> study;                 ///< the one that the card answers, or that is being calibrated
  bool under_way = false;                     ///< the calibration goes on: the page looks again by itself
  std::vector<StoredEvaluation> evaluations;  ///< in the order of arrival
  std::string program;                        ///< that made the evaluations; empty if it is not known
  std::optional<TrainingData> evidence;       ///< what the evaluations say of the study
  std::optional<Inference> inference;         ///< and what follows for its parameters
  std::vector<TestView> views;                ///< one for each test of the card; none if they were not simulated
  std::vector<std::string> missing;           ///< what is not there, or not whole: a sentence each
};

/// What a calibration has found so far, or leaves if it ends without an answer.
Findings findings_without_card(const Study& study, const Store& store);

/// What a calibration has found that ends now. `inference`: what it made of its simulations; none: it is made here.
Findings findings_of(const Card& card, const Store& store, const std::optional<Inference>& inference);

/// What the evaluations say of a card's material.
Inference inference_of(const Card& card, const TrainingData& evidence);

inline const std::string kCardFile = "card.json";

/// Reads a folder that `pastefit calibrate` wrote to. What is damaged or not there is `missing`; the rest is read.
/// `store`: name of the file with the evaluations.
/// Error: there is no such folder, or neither card nor evaluations in it.
Result<Findings> read_findings(const std::filesystem::path& folder, const std::string& store);

}  // namespace pastefit
