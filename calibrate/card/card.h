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

#include "calibrate/study/study.h"
#include "calibrate/study/tolerance.h"
#include "calibrate/study/unstated_conditions.h"
#include "core/observe/readings.h"

namespace pastefit {

/// One reading of the calibrated material, against the laboratory if it was measured there.
struct CardReading {
  std::string name;                         ///< e.g. "step1.height_mm"; the unit of all that follows
  double simulated = 0;                     ///< mean over those packings that a laboratory would accept (`accepted`)
  double simulated_standard_deviation = 0;  ///< from packing to packing
  std::optional<double> measured;           ///< mean of the laboratory's repeats; empty: not measured
  double standard_deviation = 0;            ///< of one measurement
  int repeats = 0;
  double weight = 0;                          ///< in the fit; 0: reported only
  double tolerance = 0;                       ///< how far off it may be for the material to do; 0: not measured
  std::optional<double> band = std::nullopt;  ///< of a hold-out: |simulated - measured| that the noise of both explains
  int packings = 1;                           ///< that the simulated mean and deviation are of
};

/// Of the simulated mean: simulated_standard_deviation/sqrt(packings). Nothing for one packing, which says nothing of
/// it.
std::optional<double> standard_error(const CardReading& reading);

/// What one engine read off a test of the card, packing by packing: what a regression check compares with.
struct Baseline {
  struct Run {
    std::uint64_t packing = 0;
    Readings readings;  ///< the same readings in every run
  };
  std::string program;  ///< `program_identity` of the engine
  std::string machine;  ///< `machine_type` it ran on
  std::vector<Run> runs;
};

/// The material apart from any test of it: its contact laws, in SI for grains of one size, and scale-free.
struct Material {
  double bulk_density_kg_m3 = 0;
  std::optional<double> grain_density_kg_m3;  ///< of the grains, such that they fill a mould with the bulk density
  GrainSizes grains;
  ContactModel contact;               ///< in SI, between these grains
  std::vector<Parameter> parameters;  ///< scale-free, every known one, in the order of `parameter_kinds`
};

/// The values of its parameters, in their fixed order.
std::vector<double> values_of(const Material& material);

/// A test of the material: what was asked of it, and how it answered.
struct CardTest {
  std::string name;       ///< unique; empty if it is the card's only one
  bool hold_out = false;  ///< predicted, not fitted
  std::string lab_file, lab_hash;
  Provenance lab;
  std::optional<Measurement> yield_stress = std::nullopt;  ///< that the laboratory measured [Pa]; compared, not fitted
  Test test;  ///< apparatus, grains and contact laws, in SI; the grains may be of other sizes than the material's
  std::vector<CardReading> readings;  ///< none: it was not simulated
  std::optional<bool> within_noise;   ///< of a hold-out: every reading that counts lies within its band
  Baseline baseline;                  ///< no runs: older than baselines; `readings` stand in
};

struct Card;
/// Whether the card's material has the parameter: its laws do, and one of its tests, if it is of a surface.
bool has_parameter(const Card& card, std::string_view name);

/// "slow/step1.height_mm", as in a study of several tests; the reading's own name if the test has none.
std::string reading_name(const CardTest& test, std::string_view reading);

/// "Test slow: ", for people; nothing if the test has no name.
std::string heading_of(const CardTest& test);

/// What the simulated readings of a test are: "mean +- standard deviation of the card's 8 packings", or "of 3 of the
/// card's 8 packings" where a laboratory would not accept the other heaps, or "one packing, error unknown"; empty
/// if the card has none.
std::string packings_in_words(const Card& card, const CardTest& test);

/// How well the calibrated material was confirmed.
struct Confirmation {
  std::vector<std::uint64_t> packings;  ///< seeds of the packings that the simulated readings are means over
  bool fresh = false;                   ///< the search had not seen them; false: it was stopped before
  double error = 0;                     ///< largest difference of a fitted reading over its tolerance; 1 is asked for
  bool meets_laboratory = false;        ///< on fresh packings, and their noise leaves no doubt (`verdict_on`)
  bool refuted = false;  ///< likewise it does not: its readings, or the heaps that a laboratory would reject
  /// Of heaps that a laboratory would reject, at most (1: not judged); nothing if the card was not judged on fresh
  /// packings, and in cards of version 5 without such a heap.
  std::optional<double> rejected_share = std::nullopt;
};

/// How the material was found.
struct SearchRecord {
  std::string strategy;
  std::string status;  ///< how the search ended, e.g. "confirmed"
  std::string reason;  ///< the same, one or more sentences
  std::uint64_t seed = 0;
  std::vector<std::uint64_t> packings;  ///< common random packings of the candidates
  int budget = 0;                       ///< simulations allowed
  int simulations = 0;                  ///< finished, those known from an earlier run included
  std::map<std::string, int> failures;  ///< of them, by reason
  int coarse_simulations = 0;           ///< with coarse grains, besides
};

/// From what and with what the card was made, besides the laboratory files of its tests.
struct CardProvenance {
  std::string study_file, study_hash;
  std::string program;  ///< version and engine fingerprint
};

/// What the laboratory's readings say about the fitted parameters, as far as that was worked out; all parts may be
/// empty.
struct CardInference {
  /// The range of a parameter that the readings leave open.
  struct Interval {
    std::string parameter;
    double lower = 0, upper = 0;
  };
  /// How two parameters move together within what the readings leave open, -1 to 1.
  struct Correlation {
    std::string first, second;
    double value = 0;
  };
  /// A parameter that the readings cannot see.
  struct NotIdentified {
    std::string parameter;
    std::string reason;  ///< for a person
  };
  std::string method;  ///< of the intervals, e.g. "profile likelihood"
  double level = 0;    ///< confidence of the intervals, e.g. 0.95; 0: there are none
  std::vector<Interval> intervals;
  std::vector<Correlation> correlations;
  std::vector<NotIdentified> not_identified;
  std::vector<ConditionEffect> conditions;  ///< that nobody states; contained in the intervals
};

/// A change of the baseline that was meant.
struct Rebaseline {
  struct Moved {
    std::string reading;
    double before = 0, after = 0;  ///< mean over the packings
  };
  std::string why;
  std::string program_before, program_after;
  std::vector<Moved> moved;
};

/// A card that was carried to another grain size, and what that did to its readings.
struct Rescaling {
  struct Bias {
    std::string reading;
    double before = 0, after = 0;  ///< mean over the packings of either size
    double standard_error = 0;     ///< of the difference
  };
  double from_radius_m = 0;
  std::vector<Bias> bias;  ///< empty: not measured
};

/// A test of the card as another engine simulated it, maybe with grains of another size, beside the card's own
/// confirmation.
struct FurtherConfirmation {
  struct Reading {
    std::string name;
    double card = 0;                          ///< mean of the card's own confirmation
    double simulated = 0;                     ///< mean there, over the heaps that a laboratory would accept
    double simulated_standard_deviation = 0;  ///< there, from packing to packing
    std::optional<double> standard_error;     ///< of the bias; nothing if one of both means is of one packing
    double bias() const { return simulated - card; }
  };
  std::string engine;   ///< e.g. "lammps"
  std::string program;  ///< as it calls itself, with its version
  std::string test;     ///< of the card; empty if that has one without a name
  double radius_m = 0;  ///< mean radius of the grains
  std::vector<std::uint64_t> packings;
  int accepted = 0;  ///< packings whose heap a laboratory would accept; all, if it would accept none
  int ranks = 1;
  double wall_s = 0, core_s = 0;  ///< of the time steps of all packings; processor time of all ranks together
  std::optional<double> error;    ///< as the card's own; nothing if no reading of the test is fitted
  bool meets_laboratory = false;  ///< the noise of the packings leaves no doubt (`verdict_on`)
  std::vector<Reading> readings;  ///< that both have
};

/// A material that was interpolated between calibrated ones, and fitted to no reading of its own.
struct Interpolation {
  std::string variable;  ///< of the laboratory files, e.g. "mix.water_kg_m3"
  double value = 0;
  std::string model;                 ///< "linear" or "gaussian_process"
  std::vector<std::string> studies;  ///< whose materials it lies between
};

/// "Interpolated, not confirmed: mix.water_kg_m3 195, linear between 5 materials", for people.
std::string interpolation_in_words(const Interpolation& interpolation);

/// A calibrated material: what a DEM program needs to simulate it, how well it meets the laboratory, and where it
/// comes from. File format "pastefit-card-6", `data/schema/card.schema.json`.
struct Card {
  std::string title;
  Material material;
  std::vector<CardTest> tests;  ///< at least one, on the same packings; those held out last
  Confirmation confirmation;
  SearchRecord search;
  CardProvenance provenance;
  CardInference inference;
  std::vector<Rebaseline> rebaselined;                     ///< oldest first
  std::vector<Rescaling> rescaled;                         ///< oldest first
  std::vector<FurtherConfirmation> further_confirmations;  ///< oldest first
  std::optional<Interpolation> interpolated;
};

/// The card's title, which begins with what an interpolated one is.
std::string title_of(const Card& card);

/// In which people are told the card's error.
ErrorUnit error_unit_of(const Card& card);

/// Which ends of an interval of a parameter are the bounds of the study: the readings do not set them.
struct BoundEnds {
  bool lower = false, upper = false;
};
BoundEnds ends_at_bounds(const CardInference::Interval& interval, const Parameter& parameter);
/// "13.2 to 526", with a mark at an end that the study's bound sets.
std::string interval_in_words(double lower, double upper, const BoundEnds& at_bounds, int digits);

/// The version of the card format that this program writes. It reads version 5, too.
inline constexpr int kCardVersion = 6;

/// The card as JSON (card_description.h). The numbers in SI rule; `material.parameters` is the scale-free form of the
/// same contact laws, those that they have. A test says its bulk density, grains and contact laws only where they are
/// not the material's.
nlohmann::ordered_json to_json(const Card& card);

/// Whether the document says it is a card, of any version.
bool is_card(const nlohmann::json& document);

/// Reads what `to_json` wrote. Errors: every fault at once, with its place; a card of another version.
Result<Card> card_from_json(const nlohmann::json& document);
Result<Card> read_card(const std::filesystem::path& file);

/// The JSON schema of a card, `data/schema/card.schema.json`.
nlohmann::ordered_json card_schema();

/// The card as the text of its file, which `card_from_json` reads: what replaces a card is read back first.
/// Errors: why it could not be read.
Result<std::string> readable_text(const Card& card);

/// Replaces the file by the card, whole or not at all. Errors: those of `readable_text` and `write_atomically`; what
/// was there is then as it was.
Faults write_card(const std::filesystem::path& file, const Card& card);

/// The study that a card answers, as far as the card says: its tests with what was measured and what of it counts, and
/// the parameters with their bounds. Its title, bounds and tolerances are the study's; of the search only seed,
/// strategy, packings and budget are.
Study study_of(const Card& card);

/// The card's material among that study's candidates.
Eigen::VectorXd point_of(const Card& card);

/// The card's material for grains of another mean radius, in all its tests, by the scaling rule: F/R^2 stays the same
/// function of d/R. With s = radius/old radius of the material's grains: a stays, b s, c s^2, d_c s, offset s, cohesion
/// s^2, liquid volume s^3, surface tension s, all radii of the distribution s; Young's modulus stays (contact stiffness
/// then goes with s). Source: Thakur, Ooi & Ahmadian, Powder Technology 293 (2016) 130-137.
///
/// What was simulated with the old grains (readings, confirmations, baseline, rebaselining) does not hold for the new
/// ones and is left out; `rescaled` gets a row without bias (`check/rescale_bias.h` measures it).
/// Errors: grains that a test cannot be run with (too coarse for the mould, finer than the format allows).
Result<Card> rescaled(Card card, double radius_m);

}  // namespace pastefit
