#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/study/study.h"

namespace pastefit {

/// One reading of the calibrated material, against the laboratory if it was measured there.
struct CardObservable {
  std::string name;                         ///< e.g. "step1.height_mm"; the unit of all that follows
  double simulated = 0;                     ///< mean over the confirmation packings
  double simulated_standard_deviation = 0;  ///< from packing to packing
  std::optional<double> measured;           ///< mean of the laboratory's repeats; empty: not measured
  double standard_deviation = 0;            ///< of one measurement
  int repeats = 0;
  double weight = 0;  ///< in the fit; 0: reported only
};

/// How well the calibrated material was confirmed.
struct Confirmation {
  std::vector<std::uint64_t> packings;  ///< seeds of the packings that the simulated readings are means over
  bool fresh = false;                   ///< the search had not seen them; false: it was stopped before
  double misfit_mm = 0;                 ///< root mean square difference of the fitted lengths
  double tolerance_mm = 0;              ///< what the study asked for
  bool meets_laboratory = false;        ///< on fresh packings, nothing failed, and misfit_mm <= tolerance_mm
};

/// How the material was found.
struct SearchRecord {
  std::string strategy;
  std::string status;  ///< how the search ended, e.g. "confirmed"
  std::string reason;  ///< the same, one or more sentences
  std::uint64_t seed = 0;
  std::vector<std::uint64_t> packings;  ///< common random packings of the candidates
  int budget = 0;                       ///< simulations allowed
  int simulations = 0;                  ///< finished, those known from an earlier session included
  std::map<std::string, int> failures;  ///< of them, by reason
};

/// From what and with what the card was made.
struct CardProvenance {
  std::string study_file, study_hash;
  std::string lab_file, lab_hash;
  Provenance lab;
  std::string program;  ///< version and engine fingerprint
};

/// A calibrated material: what a DEM program needs to simulate it, how well it meets the laboratory, and where it
/// comes from. File format "pastefit-card-1", `data/schema/card.schema.json`.
struct Card {
  std::string title;
  SlumpTable test;                            ///< apparatus, grains and contact laws, in SI
  std::optional<double> grain_density_kg_m3;  ///< of the grains, such that the mould holds the bulk density
  std::vector<Parameter> parameters;          ///< scale-free, every known one, in the order of `parameter_kinds`
  std::vector<CardObservable> observables;
  Confirmation confirmation;
  SearchRecord search;
  CardProvenance provenance;
};

/// The card as JSON. `test` rules; `parameters` is the scale-free form of the same contact laws.
/// Derived on writing and not read back: material.bulk_density_kg_m3 = test.bulk_density_kg_m3, difference = simulated
/// - measured, standard_error = simulated_standard_deviation/sqrt(packings).
nlohmann::ordered_json to_json(const Card& card);

/// Reads what `to_json` writes. Errors: every fault at once, with its place.
Result<Card> card_from_json(const nlohmann::json& document);
Result<Card> read_card(const std::filesystem::path& file);

}  // namespace pastefit
