#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <nlopt.hpp>
#include <stdexcept>

#include "calibrate/optimisers/problem.h"

namespace pastefit {
namespace {

constexpr int most_refused = 100;        // points that are not numbers before the run ends
constexpr int most_late_calls = 10'000;  // calls after the end before an exception stops the algorithm

/// To add an algorithm, add a row.
struct AlgorithmRow {
  std::string_view name;
  nlopt::algorithm algorithm;
  int fewest;  ///< smallest number of coordinates
};

constexpr std::array algorithms = {
    AlgorithmRow{"direct_l", nlopt::GN_DIRECT_L, 1},      AlgorithmRow{"crs2_lm", nlopt::GN_CRS2_LM, 1},
    AlgorithmRow{"bobyqa", nlopt::LN_BOBYQA, 2},          AlgorithmRow{"cobyla", nlopt::LN_COBYLA, 1},
    AlgorithmRow{"nelder_mead", nlopt::LN_NELDERMEAD, 1}, AlgorithmRow{"sbplx", nlopt::LN_SBPLX, 1},
};

const AlgorithmRow* find_algorithm(std::string_view name) {
  const auto row = std::find_if(algorithms.begin(), algorithms.end(), [&](const auto& r) { return r.name == name; });
  return row == algorithms.end() ? nullptr : &*row;
}

/// Adapter of the problem for NLopt: returns bounded numbers and records evaluations.
class Answerer {
 public:
  Answerer(const Problem& problem, const NloptOptions& options) : problem_(problem), options_(options) {}

  /// Bounded number for a point; the worst one after the end.
  double answer(const UnitPoint& asked) {
    if (ended_) {
      ++late_calls_;
      return 2;
    }
    if (!asked.allFinite()) {
      ended_ = ++refused_ >= most_refused;
      return 2;
    }
    if (!may_ask(1)) return 2;
    const UnitPoint point = asked.cwiseMax(0.0).cwiseMin(1.0);
    const Answer answer = problem_.answer({&point, 1}).at(0);
    if (run_.evaluations == 0) scale_ = std::isfinite(answer.value) && answer.value > 0 ? answer.value : 1;
    keep(answer);
    if (is_feasible(answer) && answer.good_enough) end();
    return bounded(answer);
  }

  /// After a claim of convergence: evaluates both neighbours of the best point along each coordinate, all at once. The
  /// algorithms' own tests do not suffice: simplices collapse at bounds and beside failures, and models built on a
  /// failure shrink away from the minimum.
  void check_neighbours() {
    const UnitPoint& best = run_.best.point;
    std::vector<UnitPoint> neighbours;
    for (Eigen::Index k = 0; k < best.size(); ++k) {
      for (const double step : {-options_.initial_step / 4, options_.initial_step / 4}) {
        UnitPoint neighbour = best;
        neighbour[k] = std::clamp(best[k] + step, 0.0, 1.0);
        neighbours.push_back(std::move(neighbour));
      }
    }
    if (!may_ask(static_cast<int>(neighbours.size()))) return;
    for (const Answer& answer : problem_.answer(neighbours)) keep(answer);
  }

  void end() { ended_ = true; }
  bool ended() const { return ended_; }
  int late_calls() const { return late_calls_; }
  const Optimum& run() const { return run_; }

 private:
  bool may_ask(int points) {
    if (problem_.may_evaluate && !problem_.may_evaluate(points)) end();
    if (run_.evaluations + points > options_.evaluations) end();
    return !ended_;
  }

  double bounded(const Answer& answer) const {
    const bool graded = std::isfinite(answer.value) && answer.value >= 0;
    const double share = graded ? answer.value / (answer.value + scale_) : 1;
    return is_feasible(answer) ? share : 1 + share;
  }

  void keep(const Answer& answer) {
    ++run_.evaluations;
    if (is_better(answer, run_.best)) run_.best = answer;
  }

  const Problem& problem_;
  const NloptOptions& options_;
  Optimum run_;
  double scale_ = 1;  // value of the start: middle of the bounded range
  int refused_ = 0;
  int late_calls_ = 0;
  bool ended_ = false;
};

/// Data of NLopt's callback. It also carries exceptions of the problem, whose type NLopt would lose.
struct Question {
  Answerer& answerer;
  nlopt::opt& optimiser;
  Eigen::Index dimension;
  std::exception_ptr thrown;
};

double ask(unsigned, const double* x, double*, void* data) {
  Question& question = *static_cast<Question*>(data);
  double value = 2;
  try {
    value = question.answerer.answer(Eigen::Map<const Eigen::VectorXd>(x, question.dimension));
  } catch (...) {
    question.thrown = std::current_exception();
    question.answerer.end();
  }
  if (question.answerer.ended()) question.optimiser.force_stop();
  if (question.answerer.late_calls() > most_late_calls) throw nlopt::forced_stop();
  return value;
}

void configure(nlopt::opt& optimiser, const AlgorithmRow& row, unsigned dimension, const NloptOptions& options) {
  optimiser.set_lower_bounds(0.0);
  optimiser.set_upper_bounds(1.0);
  optimiser.set_xtol_abs(options.step_tolerance);
  optimiser.set_initial_step(options.initial_step);
  optimiser.set_maxeval(options.evaluations + 1);
  if (row.algorithm == nlopt::GN_CRS2_LM) {
    // NLopt's default, ten for each coordinate, would spend a small budget on the first generation.
    const unsigned generations = 5;
    const unsigned share = static_cast<unsigned>(options.evaluations) / generations;
    optimiser.set_population(std::clamp(share, dimension + 2, 10 * (dimension + 1)));
  }
}

void run_algorithm(Answerer& answerer, const UnitPoint& start, const NloptOptions& options) {
  const AlgorithmRow& row = *find_algorithm(options.algorithm);
  // Algorithms that cannot search one coordinate get further ones without effect.
  const int dimension = std::max(static_cast<int>(start.size()), row.fewest);
  nlopt::opt optimiser(row.algorithm, static_cast<unsigned>(dimension));
  configure(optimiser, row, static_cast<unsigned>(dimension), options);
  Question question{answerer, optimiser, start.size(), nullptr};
  optimiser.set_min_objective(ask, &question);
  nlopt::srand(static_cast<unsigned long>(options.seed));
  std::vector<double> x(static_cast<std::size_t>(dimension), 0.5);
  std::copy(start.begin(), start.end(), x.begin());
  nlopt::result result = nlopt::FAILURE;
  try {
    double least = 0;
    result = optimiser.optimize(x, least);
  } catch (const std::exception&) {  // the result is a failure
  }
  if (question.thrown) std::rethrow_exception(question.thrown);
  const bool converged = result > 0 && result < nlopt::MAXEVAL_REACHED;
  if (converged && !answerer.ended()) answerer.check_neighbours();
}

}  // namespace

std::vector<std::string_view> nlopt_algorithm_names() {
  std::vector<std::string_view> names;
  for (const AlgorithmRow& row : algorithms) names.push_back(row.name);
  return names;
}

Optimum minimise(const Problem& problem, const UnitPoint& start, const NloptOptions& options) {
  const bool inside = start.size() == problem.parameters && (start.array() >= 0).all() && (start.array() <= 1).all();
  if (!inside || !find_algorithm(options.algorithm))
    throw std::logic_error("minimise: start outside the unit cube, or an unknown algorithm");
  Answerer answerer(problem, options);
  answerer.answer(start);
  if (!answerer.ended()) run_algorithm(answerer, start, options);
  return answerer.run();
}

UnitPoint least_point(const std::function<double(const UnitPoint&)>& function, const UnitPoint& start) {
  const Problem problem = scalar_problem(static_cast<int>(start.size()), function);
  NloptOptions options;
  options.algorithm = "direct_l";
  options.evaluations = 150 * problem.parameters;
  const UnitPoint rough = minimise(problem, start, options).best.point;
  options.algorithm = "bobyqa";
  options.initial_step = 0.1;
  return minimise(problem, rough, options).best.point;
}

}  // namespace pastefit
