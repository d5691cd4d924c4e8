#include "calibrate/search/screening.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "calibrate/search/surrogate.h"

namespace pastefit {

std::uint64_t hash_of(std::uint64_t seed, std::uint64_t counter) {
  std::uint64_t z = seed * 0xd1342543de82ef95ULL + (counter + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::vector<UnitPoint> screening_points(int dimension, int count, std::uint64_t seed) {
  if (dimension < 1 || count < 0) throw std::logic_error("screening_points: needs dimension >= 1 and count >= 0");
  UnitPoint shift = UnitPoint::Zero(dimension);
  if (seed != 0) {
    for (int k = 0; k < dimension; ++k) {
      shift[k] = std::ldexp(static_cast<double>(hash_of(seed, static_cast<std::uint64_t>(k)) >> 11), -53);
    }
  }
  // The engine omits the corner 0 and yields 64-bit integers; their top 53 bits give exact coordinates on every
  // machine.
  boost::random::sobol engine(dimension);
  std::vector<UnitPoint> points(count, UnitPoint(dimension));
  for (UnitPoint& point : points) {
    for (int k = 0; k < dimension; ++k) {
      const double moved = std::ldexp(static_cast<double>(engine() >> 11), -53) + shift[k];
      point[k] = moved >= 1 ? moved - 1 : moved;
    }
  }
  return points;
}

namespace {

/// The first points do not depend on `count`.
std::vector<UnitPoint> likely_points(const StrategyState& state, int count) {
  const UnitBox box = state.scoring().likely_box();
  std::vector<UnitPoint> points = screening_points(state.scoring().parameters(), count, state.options.seed);
  for (UnitPoint& point : points) point = box.lower + point.cwiseProduct(box.upper - box.lower);
  return points;
}

}  // namespace

bool ScreeningPhase::advance() {
  EvaluationHistory& history = state_.history;
  if (known_ < 0) {
    history.enter("screening");
    known_ = static_cast<int>(history.singles().size());
    if (fidelity_ == Fidelity::coarse) {
      history.evaluate_coarse(likely_points(state_, state_.options.screening),
                              packings_of_coarse(state_.options.seed, 1));
      return false;
    }
  }
  if (fidelity_ == Fidelity::coarse) return true;
  const bool enough = history.any_feasible() && known_ + asked_ >= state_.options.screening;
  if (enough || history.stop_requested()) return true;
  const int missing = state_.options.screening - (history.any_feasible() ? known_ + asked_ : 0);
  const int count = std::min(missing, history.budget_left());
  const int most = state_.options.budget_simulations / state_.scoring().simulations_each() / 2;
  if (count < 1 || asked_ > most) return true;
  const auto points = likely_points(state_, asked_ + count);
  history.try_out(std::span(points).last(count), std::span(state_.common).first(1));
  asked_ += count;
  return false;
}

}  // namespace pastefit
