#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// A reading of the laboratory that no material within the bounds comes near.
struct OutOfReach {
  std::size_t reading = 0;  ///< in the order of the observables
  bool above = true;        ///< the model stays above the laboratory; else below
  double measured = 0;      ///< by the laboratory, in the reading's unit
  double likely = 0;        ///< mean reading of the candidate that comes nearest, as the simulations tell it
  double at_best = 0;       ///< what no simulation is likely to pass, predictive variance and noise counted
  UnitPoint nearest;        ///< that candidate
  struct Bound {
    int parameter = 0;   ///< free parameter, in their order
    bool upper = false;  ///< the nearest candidate lies on its upper bound; else on the lower one
  };
  std::vector<Bound> bounds;  ///< that stand in the way: a step back from them moves the reading off; may be empty
};

struct ReachOptions {
  std::uint64_t packing = 1;  ///< of the probes
  int probes = 12;            ///< simulations that may be spent
};

/// Asks whether the laboratory's readings lie within what the model can do, before a search is paid for.
///
/// Suspect is a fitted reading that all simulations so far miss on the same side, by more than two standard deviations
/// of the laboratory and by more than its tolerance. A Gaussian process of the reading then says how far any candidate
/// may get at best: its mean less three standard deviations of its predictive variance and of one simulation's noise
/// together, and more than three where few simulations tell them (Student's t). The candidate that may get farthest is
/// simulated, and so on (a lower confidence bound; Cox & John 1992), until the reading is met (it is within reach),
/// nothing is left that might meet it (it is out of reach, which is the answer), or the probes are spent (nothing is
/// said). Probes stay in the history and serve the search.
///
/// A simulation that failed says nothing of the reading, and the model knows nothing of where such ones lie. So there
/// is no claim unless more candidates finished than did not, and all of those nearest to where the bound lies did.
/// Simulations that ended early are run whole before anything is judged by them, or if all have ended so:
/// how far they would have gone is the question. Limit: a narrow region of the cube that answers unlike all the rest
/// can be overlooked; `contradicts` says when one is found after all.
class ReachPhase : public SearchPhase {
 public:
  ReachPhase(EvaluationHistory& history, const ReachOptions& options) : history_(history), options_(options) {}
  bool advance() override;
  const std::optional<OutOfReach>& found() const { return found_; }

 private:
  /// Asks for what tells more of a reading, or decides; false if it asked.
  bool probe(std::size_t reading);

  EvaluationHistory& history_;
  const ReachOptions options_;
  std::size_t reading_ = 0;
  int probes_ = 0;                    // made
  std::optional<std::size_t> known_;  // simulations before the last probe
  std::optional<OutOfReach> found_;
};

/// What may come near: single simulations, whose noise helps them, or a candidate's mean over packings.
enum class ReachOf { simulations, means };

/// The same by what is known; simulates nothing. One that ended early counts as one that did not finish.
std::optional<OutOfReach> known_out_of_reach(const EvaluationHistory& history, ReachOf what);

/// True if the simulation reads what was said to be out of reach, or more.
bool contradicts(const Response& single, const OutOfReach& found);

/// The answer in words. Names may be missing: "reading 1", "parameter 2".
std::string describe(const OutOfReach& found, std::span<const std::string> readings,
                     std::span<const std::string> parameters);

/// That the answer is withdrawn, because of what was simulated since.
std::string describe_withdrawal(const OutOfReach& found, std::span<const std::string> readings);

/// What the simulations so far did with the fitted readings, where nothing is out of reach for certain.
std::string describe_screening(std::span<const Response> singles, std::span<const std::string> readings);

}  // namespace pastefit
