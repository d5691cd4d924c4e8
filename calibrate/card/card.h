#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/statistics.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"
#include "calibrate/study/unstated_conditions.h"
#include "core/observe/readings.h"

namespace pastefit {

/// One reading of the calibrated material, with the measurement if there is one.
struct CardReading {
  std::string name;                ///< e.g. "step1.height_mm"; gives the unit of all below
  Sample simulated{1};             ///< over the accepted packings (`accepted`)
  std::optional<double> measured;  ///< mean of the repeats; empty: not measured
  double standard_deviation = 0;   ///< of one measurement
  int repeats = 0;
  double weight = 0;                          ///< in the fit; 0: reported only
  double tolerance = 0;                       ///< largest accepted difference; 0: not measured
  std::optional<double> band = std::nullopt;  ///< of a hold-out: largest difference explained by the noise of both
};

/// Standard error of the simulated mean: standard deviation/sqrt(packings). Empty for one packing.
std::optional<double> standard_error(const CardReading& reading);

/// Readings of one engine in a test of the card, packing by packing: reference of regression checks.
struct Baseline {
  struct Run {
    std::uint64_t packing = 0;
    Readings readings;  ///< the same readings in every run
  };
  std::string program;  ///< `program_identity` of the engine
  std::string machine;  ///< `machine_type` it ran on
  std::vector<Run> runs;
};

/// Values of one reading, in the order of the runs.
std::vector<double> column_of(const std::vector<Baseline::Run>& runs, std::string_view name);

/// Material without its tests: contact laws, in SI for grains of one size, and scale-free.
struct Material {
  double bulk_density_kg_m3 = 0;
  std::optional<double> grain_density_kg_m3;  ///< such that the grains fill a mould with the bulk density
  GrainSizes grains;
  ContactModel contact;               ///< in SI, between these grains
  std::vector<Parameter> parameters;  ///< scale-free, all known ones, in the order of `parameter_kinds`
};

/// Values of its parameters, in their fixed order.
std::vector<double> values_of(const Material& material);

struct CardTest {
  std::string name;       ///< unique; empty for a single test
  bool hold_out = false;  ///< predicted, not fitted
  std::string lab_file, lab_hash;
  Provenance lab;
  std::optional<Measurement> yield_stress = std::nullopt;  ///< measured [Pa]; compared, not fitted
  Test test;  ///< apparatus, grains and contact laws, in SI; grains may differ from the material's
  std::vector<CardReading> readings;  ///< empty: not simulated
  std::optional<bool> within_noise;   ///< of a hold-out: every weighted reading is within its band
  Baseline baseline;                  ///< no runs: an older card; `readings` replace it
};

struct Card;
/// True if the material has the parameter: its laws use it, or for a surface parameter one of its tests.
bool has_parameter(const Card& card, std::string_view name);

/// "Test slow: ", for messages; empty if the test has no name.
std::string heading_of(const CardTest& test);

/// Describes the simulated readings of a test: "mean +- standard deviation of the card's 8 packings", "of 3 of the
/// card's 8 packings" if the other heaps are rejected, or "one packing, error unknown"; empty if the card has none.
std::string packings_in_words(const Card& card, const CardTest& test);

struct Confirmation {
  std::vector<std::uint64_t> packings;  ///< seeds; the simulated readings are means over these packings
  bool fresh = false;                   ///< not used by the search; false: stopped before a confirmation
  double error = 0;                     ///< largest difference of a fitted reading over its tolerance; accepted up to 1
  bool meets_laboratory = false;        ///< on fresh packings, noise included (`verdict_on`)
  bool refuted = false;                 ///< likewise rejected, by its readings or its heaps
  /// Largest accepted share of rejected heaps (1: not judged); empty if the card was not judged on fresh packings, and
  /// in cards of version 5 without a rejected heap.
  std::optional<double> rejected_share = std::nullopt;
};

struct SearchRecord {
  std::string strategy;
  std::string status;  ///< final status, e.g. "confirmed"
  std::string reason;  ///< the same in one or more sentences
  std::uint64_t seed = 0;
  std::vector<std::uint64_t> packings;  ///< common random packings of the candidates
  int budget = 0;                       ///< simulations allowed
  int simulations = 0;                  ///< finished ones, including those known from an earlier run
  std::map<std::string, int> failures;  ///< of them, by reason
  int coarse_simulations = 0;           ///< with coarse grains, not in the above
};

/// Source of the card, besides the laboratory files of its tests.
struct CardProvenance {
  std::string study_file, study_hash;
  std::string program;                     ///< version and engine fingerprint
  std::vector<std::string> settings = {};  ///< `Study::settings`
};

/// Inference of the fitted parameters from the measurements; all parts may be empty.
struct CardInference {
  struct Interval {
    std::string parameter;
    double lower = 0, upper = 0;
  };
  /// Posterior correlations of a parameter with others, -1 to 1; each pair is in one row.
  struct Correlations {
    struct With {
      std::string second;
      double value = 0;
    };
    std::string first;
    std::vector<With> others;
  };
  struct NotIdentified {
    std::string parameter;
    std::string reason;  ///< text for the user
  };
  std::string method;  ///< of the intervals, e.g. "likelihood of the readings, sampled over the bounds"
  double level = 0;    ///< probability of the intervals, e.g. 0.95; 0: there are none
  std::vector<Interval> intervals;
  std::vector<Correlations> correlations;
  std::vector<NotIdentified> not_identified;
  std::vector<ConditionEffect> conditions;  ///< not stated in any file; included in the intervals
};

/// Intended change of the baseline.
struct Rebaseline {
  struct Moved {
    std::string reading;
    double before = 0, after = 0;  ///< mean over the packings
  };
  std::string why;
  std::string program_before, program_after;
  std::vector<Moved> moved;
};

/// Rescaling of a card to another grain size, with its effect on the readings.
struct Rescaling {
  struct Bias {
    std::string reading;
    double before = 0, after = 0;  ///< means over the packings of each size
    double standard_error = 0;     ///< of the difference
  };
  double from_radius_m = 0;
  std::vector<Bias> bias;  ///< empty: not measured
};

/// A test of the card simulated by another engine, possibly with another grain size.
struct FurtherConfirmation {
  struct Reading {
    std::string name;
    double card = 0;                          ///< mean of the card's own confirmation
    double simulated = 0;                     ///< mean of the other engine, over the accepted heaps
    double simulated_standard_deviation = 0;  ///< of the other engine, between packings
    std::optional<double> standard_error;     ///< of the bias; empty if either mean is of one packing
    double bias() const { return simulated - card; }
  };
  std::string engine;   ///< e.g. "lammps"
  std::string program;  ///< its own name, with version
  std::string test;     ///< name in the card; empty for a single test without name
  double radius_m = 0;  ///< mean radius of the grains
  std::vector<std::uint64_t> packings;
  int accepted = 0;  ///< accepted packings; all if all are rejected
  int ranks = 1;
  double wall_s = 0, core_s = 0;  ///< of the time steps of all packings; core_s: processor time of all ranks together
  std::optional<double> error;    ///< as in `Confirmation`; empty if the test has no fitted reading
  bool meets_laboratory = false;  ///< noise included (`verdict_on`)
  std::vector<Reading> readings;  ///< those of both
};

/// Material interpolated between calibrated ones, not fitted to a reading of its own.
struct Interpolation {
  std::string variable;  ///< of the laboratory files, e.g. "mix.water_kg_m3"
  double value = 0;
  std::string model;                 ///< "linear" or "gaussian_process"
  std::vector<std::string> studies;  ///< of the materials between which it lies
};

/// "Interpolated, not confirmed: mix.water_kg_m3 195, linear between 5 materials", for messages.
std::string interpolation_in_words(const Interpolation& interpolation);

/// Calibrated material: input of a DEM program, agreement with the measurements, and source. File format
/// "pastefit-card-6", `data/schema/card.schema.json`.
struct Card {
  std::string title;
  Material material;
  std::vector<CardTest> tests;  ///< at least one, all on the same packings; held-out ones last
  Confirmation confirmation;
  SearchRecord search;
  CardProvenance provenance;
  CardInference inference;
  std::vector<Rebaseline> rebaselined;                     ///< oldest first
  std::vector<Rescaling> rescaled;                         ///< oldest first
  std::vector<FurtherConfirmation> further_confirmations;  ///< oldest first
  std::optional<Interpolation> interpolated;
};

/// Title of the card; begins with `interpolation_in_words` if interpolated.
std::string title_of(const Card& card);

ErrorUnit error_unit_of(const Card& card);

/// Ends of an interval that are bounds of the study, not set by the readings.
struct BoundEnds {
  bool lower = false, upper = false;
};
BoundEnds ends_at_bounds(const CardInference::Interval& interval, const Parameter& parameter);
/// "13.2 to 526", marked at an end that is the study's bound.
std::string interval_in_words(double lower, double upper, const BoundEnds& at_bounds, int digits);

/// Version of the card format that this program writes. It also reads version 5.
inline constexpr int kCardVersion = 6;

/// The card as JSON (card_description.h). The numbers in SI take precedence; `material.parameters` is the scale-free
/// form of the same contact laws, limited to their parameters. A test lists bulk density, grains and contact laws only
/// if they differ from the material's.
nlohmann::ordered_json to_json(const Card& card);

/// True if the document claims to be a card, of any version.
bool is_card(const nlohmann::json& document);

/// Reads the output of `to_json`. Errors: all faults at once, with places; a card of another version.
Result<Card> card_from_json(const nlohmann::json& document);
Result<Card> read_card(const std::filesystem::path& file);

/// JSON schema of a card, `data/schema/card.schema.json`.
nlohmann::ordered_json card_schema();

/// Text of the card's file, verified by reading it back with `card_from_json`. Errors: those of reading it.
Result<std::string> readable_text(const Card& card);

/// Replaces the file atomically. Errors: those of `readable_text` and `write_atomically`; the old file then remains.
Faults write_card(const std::filesystem::path& file, const Card& card);

/// Study of a card, as far as the card records it: tests with measurements and weights, parameters with bounds, title
/// and tolerances; of the search only seed, strategy, packings and budget.
Study study_of(const Card& card);

/// The card's material as a point of that study.
Eigen::VectorXd point_of(const Card& card);

/// The card with another material of the same laws, for example one that fits the readings as well: not simulated, so
/// without readings, confirmation and intervals. `values`: of `parameter_kinds()`.
Card with_other_material(Card card, const std::vector<double>& values);

/// The card's material for another mean radius of its grains, in all its tests, by the scaling rule: F/R^2 stays the
/// same function of d/R. With s = radius/old radius: a stays, b s, c s^2, d_c s, offset s, cohesion s^2, liquid volume
/// s^3, surface tension s, all radii of the distribution s; Young's modulus stays (contact stiffness is then
/// proportional to s). Source: Thakur, Ooi & Ahmadian, Powder Technology 293 (2016) 130-137.
///
/// Results of the old grains (readings, confirmations, baseline, rebaselining) are removed; `rescaled` gets a row
/// without bias (`with_measured_bias` measures it). Errors: grains unsuitable for a test (too coarse for the mould,
/// finer than the format allows).
Result<Card> rescaled(Card card, double radius_m);

}  // namespace pastefit
