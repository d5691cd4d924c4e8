#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/laboratory/engine.h"

namespace pastefit {

struct Impact;

/// `simulate` of an impact.
Outcome simulate_impact(const Impact& test);

/// What a check asks of the engine besides, and what the engine is called.
struct CheckEngine : Engine {
  std::function<Outcome(const Impact&)> meet = simulate_impact;
  std::string program, machine;  ///< as in `Baseline`
  /// The program this is, on this machine.
  static CheckEngine ours();
};

struct CheckOptions {
  bool quick = false;  ///< the first two packings only
  double false_alarm =
      1e-3;           ///< probability that a card is called wrong although nothing changed, all readings together
  bool bits = false;  ///< other bits are a disagreement even if the program is another
  int threads = 0;    ///< simulations at the same time; 0: one for each core
};

/// The answer for a card or for one of its readings.
enum class CheckVerdict { agrees, disagrees, not_checked };
std::string_view name_of(CheckVerdict verdict);  ///< "agrees", "disagrees", "not checked"

/// Whether the simulations repeated the card's, bit for bit.
enum class SameBits {
  same,            ///< they did
  other,           ///< they did not
  not_comparable,  ///< the card keeps no single runs
};
std::string_view name_of(SameBits bits);  ///< "same", "other", "not comparable"

/// One comparison.
struct CheckedReading {
  std::string name;  ///< a reading, with the name of its test if it has one, or "law.attraction_n at 0.25 d_c"
  double expected = 0, got = 0;  ///< means
  double band = 0;               ///< |got - expected| must not exceed it; 0: a reading without noise
  int expected_count = 0, got_count = 0;
  bool agrees() const;
};

struct CardCheck {
  std::string card;  ///< title
  CheckVerdict verdict = CheckVerdict::not_checked;
  SameBits bits = SameBits::not_comparable;
  bool same_program = false;  ///< same program on the same type of machine: the same bits are promised
  std::string reason;         ///< one sentence or more for a person
  std::vector<CheckedReading> readings;
  double false_alarm = 0;
  int simulations = 0;
};

/// How many simulations a check of the card takes, and one against a laboratory's readings.
int simulations_to_check(const Card& card, const CheckOptions& options);
int simulations_to_check_against(const Card& card, const CheckOptions& options);

/// Simulates again what the card promises.
///
/// First the contact law: the attraction of two grains that are pulled apart, against the card's formula at several
/// gaps (to 1e-6 of the force at touch). Then every test of the card, in the packings of its baseline. If the card was
/// made by the same program on the same type of machine, the same bits are expected. Otherwise each reading has to
/// agree within `band_of`, the false alarm rate divided by the number of readings (Bonferroni). A simulation that fails
/// is a disagreement. Not checked: a card with fewer than two runs.
CardCheck check(const Card& card, const CheckOptions& options, const CheckEngine& engine = CheckEngine::ours());

/// Another test with the card's contact laws and, unless the size of grains is the laboratory's in either test, its
/// grains; its surfaces are the card's, where that has them, or else as the card's parameters say.
Test with_material_of(const Card& card, Test test);

/// Judges the material by other readings of a laboratory: its contact laws and grains in that laboratory's test,
/// against the readings, within the noise of both (`unequal_band_of`).
/// Not checked: the card's grains do not fit the laboratory's test.
CardCheck check_against(const Card& card, const Lab& lab, const CheckOptions& options,
                        const CheckEngine& engine = CheckEngine::ours());

/// The card with what the engine gives now as its baseline, in at least as many packings as before; records why.
/// Errors: a simulation fails.
Result<Card> rebaselined(Card card, const std::string& why, int packings, const CheckOptions& options,
                         const CheckEngine& engine = CheckEngine::ours());

}  // namespace pastefit
