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
  std::size_t reading = 0;  ///< in the order of the readings
  bool above = true;        ///< the model stays above the laboratory; else below
  double measured = 0;      ///< by the laboratory, in the reading's unit
  double likely = 0;        ///< predicted mean reading of the candidate that comes nearest
  double at_best = 0;       ///< nearest reading that a simulation may reach, predictive variance and noise included
  UnitPoint nearest;        ///< that candidate
  struct Bound {
    int parameter = 0;   ///< free parameter, in their order
    bool upper = false;  ///< the nearest candidate lies on its upper bound; else on the lower one
  };
  std::vector<Bound> bounds;  ///< that stand in the way: a step away from them moves the reading off; may be empty
};

struct ReachOptions {
  std::uint64_t packing = 1;  ///< of the probes
  int probes = 12;            ///< simulations that may be spent
};

/// Asks whether the laboratory's readings lie within the range of the model, before the budget of a search is spent.
///
/// A fitted reading is suspect if all simulations so far miss it on the same side, by more than two standard deviations
/// of the laboratory and by more than its tolerance. A Gaussian process of the difference to the laboratory then gives
/// a lower confidence bound for every candidate: the mean less three standard deviations, predictive variance and noise
/// of one simulation together; more than three if few simulations estimate them (Student's t). The candidate of least
/// bound is simulated, and so on (Cox & John 1992), until the reading is met (it is within reach), no candidate has a
/// bound that meets it (it is out of reach, which is the answer), or the probes are spent (no answer). Probes stay in
/// the history and serve the search.
///
/// A failed simulation says nothing about the reading, and the Gaussian process does not know where simulations fail.
/// So there is no claim unless more candidates finished than did not, and all of those nearest to the candidate of
/// least bound did. Simulations that were stopped early are first run to their end, since the question is how far they
/// would have gone. Limit: a narrow region of the cube that differs from the rest can be overlooked; `contradicts`
/// says when one is found after all.
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

/// What is asked to come near: a single simulation, whose noise may help, or a candidate's mean over packings.
enum class ReachOf { simulations, means };

/// The same from the simulations at hand, without new ones. A simulation that was stopped early counts as not finished.
std::optional<OutOfReach> known_out_of_reach(const EvaluationHistory& history, ReachOf what);

/// True if the simulation's reading is as near to the laboratory's as was said to be out of reach, or nearer.
bool contradicts(const Response& single, const OutOfReach& found);

/// The answer in words. Names may be missing: "reading 1", "parameter 2".
std::string describe(const OutOfReach& found, std::span<const std::string> readings,
                     std::span<const std::string> parameters);

/// That the answer is withdrawn, because of what was simulated since.
std::string describe_withdrawal(const OutOfReach& found, std::span<const std::string> readings);

/// What the simulations so far did with the fitted readings, where nothing is out of reach for certain.
std::string describe_screening(std::span<const Response> singles, std::span<const std::string> readings);

}  // namespace pastefit
