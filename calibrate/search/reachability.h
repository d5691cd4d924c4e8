#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// A measured reading that no material within the bounds approaches.
struct OutOfReach {
  std::size_t reading = 0;  ///< index of the reading
  bool above = true;        ///< simulations exceed the measurement; else they are below
  double measured = 0;      ///< measured value [unit of the reading]
  double likely = 0;        ///< predicted mean reading at `nearest`
  double at_best = 0;       ///< confidence bound of a simulated reading nearest to the measurement
  UnitPoint nearest;        ///< candidate whose predicted reading is nearest
  struct Bound {
    int parameter = 0;   ///< index of the free parameter
    bool upper = false;  ///< `nearest` lies on the upper bound; else on the lower one
  };
  std::vector<Bound> bounds;  ///< bounds that limit the reading: a step inwards moves it away; may be empty
};

/// Tests whether the measured readings lie within the range of the model, before the search spends its budget.
///
/// A fitted reading is suspect if all simulations miss it on the same side by more than two standard deviations of the
/// measurement and more than its tolerance. A Gaussian process of the difference gives a lower confidence bound at
/// every point: mean less three standard deviations of predictive variance and noise of one simulation together, more
/// with few simulations (Student's t). The point of least bound is simulated, and the model updated (Cox & John 1992),
/// until the reading is met (within reach), no bound meets it (out of reach), or the probes are spent (undecided).
/// Probes stay in the history for the search.
///
/// A failed simulation has no reading, and the Gaussian process does not model failures. A reading is therefore called
/// out of reach only if more candidates finished than did not, and all nearest to the point of least bound finished.
/// Simulations that were stopped early are first completed. Limit: a narrow region that differs from the rest of the
/// cube may be overlooked; `contradicts` detects it when the search finds it.
class ReachPhase : public SearchPhase {
 public:
  /// `packing`: of the probes; `most_probes`: simulations allowed.
  ReachPhase(EvaluationHistory& history, std::uint64_t packing, int most_probes)
      : history_(history), packing_(packing), most_probes_(most_probes) {}
  bool advance() override;
  const std::optional<OutOfReach>& found() const { return found_; }

 private:
  /// Requests the next simulation for `reading_`, or decides; false if it requested one.
  bool probe();

  EvaluationHistory& history_;
  const std::uint64_t packing_;
  const int most_probes_;
  std::size_t reading_ = 0;
  int probes_ = 0;                    // simulated
  std::optional<std::size_t> known_;  // number of simulations before the last probe
  std::optional<OutOfReach> found_;
};

/// What has to meet the measurement: a single simulation, noise included, or the mean over packings.
enum class ReachOf { simulations, means };

/// The same test on existing simulations. A simulation that was stopped early counts as not finished.
std::optional<OutOfReach> known_out_of_reach(const EvaluationHistory& history, ReachOf what);

/// True if the simulation's reading is at `at_best` or nearer to the measurement.
bool contradicts(const Response& single, const OutOfReach& found);

/// The result as text. Missing names become "reading 1", "parameter 2".
std::string describe(const OutOfReach& found, std::span<const std::string> readings,
                     std::span<const std::string> parameters);

/// Message that later simulations refute the result.
std::string describe_withdrawal(const OutOfReach& found, std::span<const std::string> readings);

/// Ranges of the fitted readings, for the case that none is out of reach.
std::string describe_screening(std::span<const Response> singles, std::span<const std::string> readings);

}  // namespace pastefit
