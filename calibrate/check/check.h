#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/laboratory/engine.h"
#include "core/apparatus/impact/impact.h"

namespace pastefit {

/// Engine of a check, with impacts and its identity.
struct CheckEngine : Engine {
  std::function<Outcome(const Impact&)> meet = [](const Impact& test) { return simulate(test); };
  std::string program, machine;  ///< as in `Baseline`
  /// This program on this machine.
  static CheckEngine ours();
};

/// Simulates `test` in each packing, in parallel; outcomes in their order.
std::vector<Outcome> outcomes_of(const Test& test, const std::vector<std::uint64_t>& packings,
                                 const CheckEngine& engine, int threads);

/// Message of a failure: "packing 7: failed (never_settled in step1)".
Fault failure_in(std::uint64_t packing, const Failure& failure, const std::string& heading = "");

/// Their readings. `heading`: prefix of faults (`heading_of`). Errors: a simulation fails.
Result<std::vector<Baseline::Run>> baseline_runs(const Test& test, const std::string& heading,
                                                 const std::vector<std::uint64_t>& packings, const CheckEngine& engine,
                                                 int threads);

struct CheckOptions {
  bool quick = false;         ///< first two packings only
  double false_alarm = 1e-3;  ///< probability of rejecting an unchanged card, all readings together
  bool bits = false;          ///< different bits are a disagreement even for another program
  int threads = 0;            ///< simulations at a time; 0: one for each core
};

enum class CheckVerdict { agrees, disagrees, not_checked };
std::string_view name_of(CheckVerdict verdict);  ///< "agrees", "disagrees", "not checked"

/// Whether the simulations repeat the card's bit for bit; of several tests the last of these counts.
enum class SameBits {
  same,            ///< identical
  not_comparable,  ///< the card has no single runs
  other            ///< different
};
std::string_view name_of(SameBits bits);  ///< "same", "other", "not comparable"

struct CheckedReading {
  std::string name;              ///< reading, with the name of its test if any, or "law.attraction_n at 0.25 d_c"
  double expected = 0, got = 0;  ///< means
  double band = 0;               ///< largest accepted |got - expected|; 0: no noise
  int expected_count = 0, got_count = 0;
  bool agrees() const;
};

struct CardCheck {
  std::string card;  ///< title
  CheckVerdict verdict = CheckVerdict::not_checked;
  SameBits bits = SameBits::not_comparable;
  bool same_program = false;  ///< same program and type of machine: equal bits are required
  std::string reason;         ///< one or more sentences for the user
  std::vector<CheckedReading> readings;
  double false_alarm = 0;
  int simulations = 0;
};

/// Number of simulations of a check of the card, and of one against laboratory readings.
int simulations_to_check(const Card& card, const CheckOptions& options);
int simulations_to_check_against(const Card& card, const CheckOptions& options);

/// Repeats the simulations of a card.
///
/// First the contact law: the attraction of two grains that are pulled apart, against the card's formula at several
/// gaps (to 1e-6 of the force at touch). Then every test of the card, in the packings of its baseline. The same program
/// on the same type of machine has to give the same bits. Otherwise each reading has to agree within `band_of`, for the
/// false alarm rate divided by the number of readings (Bonferroni). A failed simulation is a disagreement. Not checked:
/// a card with fewer than two runs.
CardCheck check(const Card& card, const CheckOptions& options, const CheckEngine& engine = CheckEngine::ours());

/// A test with the card's contact laws and, unless either test prescribes its grain size, the card's grains. Its
/// surfaces are the card's where they exist, else they follow from the card's parameters.
Test with_material_of(const Card& card, Test test);

/// Compares the material, in the test of another laboratory file, with its readings, within the noise of both
/// (`unequal_band_of`). Not checked: the card's grains do not fit that test.
CardCheck check_against(const Card& card, const Lab& lab, const CheckOptions& options,
                        const CheckEngine& engine = CheckEngine::ours());

/// The card with a new baseline by this engine, in at least as many packings as before; records why. Errors: a
/// simulation fails.
Result<Card> rebaselined(Card card, const std::string& why, int packings, const CheckOptions& options,
                         const CheckEngine& engine = CheckEngine::ours());

/// Measures the effect of another grain size on a card's readings: simulates `before` and `after` (`rescaled(before)`)
/// in `packings` random packings each. Returns `after` with new readings, confirmation and baseline, and with the bias
/// of every reading and its standard error. Requirement: packings >= 2. Errors: a simulation fails.
Result<Card> with_measured_bias(const Card& before, Card after, int packings, const CheckOptions& options,
                                const CheckEngine& engine = CheckEngine::ours());

/// Compares runs of another engine with the card's own confirmation. `test`: of the card; `simulated`: the same as
/// simulated by that engine, possibly with other grains; `done`: has the engine, its program and the cost of the runs.
/// Requirement: at least one run. The bias of a reading is the other mean less the card's, over accepted heaps; its
/// standard error is sqrt(s^2/n + s_card^2/n_card). `confirmation_by` judges readings and heaps; an interpolated
/// material, and a test without fitted reading, never meets the laboratory.
FurtherConfirmation further_confirmation(const Card& card, const CardTest& test, const Test& simulated,
                                         const std::vector<Baseline::Run>& runs, FurtherConfirmation done);

/// Card file and its check. A card that cannot be read is `not_checked`, with the faults as reason.
struct CheckedFile {
  std::filesystem::path file;
  CardCheck check;
  double seconds = 0;  ///< wall time
};

/// Check as text: a table of readings, and the verdict with its reason.
std::string text_of(const CheckedFile& checked);

/// {"agree", "disagree", "not_checked", "cards": [...]}.
nlohmann::ordered_json to_json(const std::vector<CheckedFile>& checked);

/// JUnit's XML: one test case for each card; `disagrees` is a failure, `not_checked` an error.
std::string junit_of(const std::vector<CheckedFile>& checked);

}  // namespace pastefit
