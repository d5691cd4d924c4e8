#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Adapter of the problem for Ceres; records evaluations and hides failures.
class Residuals : public ceres::CostFunction {
 public:
  Residuals(const Problem& problem, const CeresOptions& options) : problem_(problem), options_(options) {
    mutable_parameter_block_sizes()->push_back(problem.parameters);
    set_num_residuals(problem.residuals);
  }

  /// Exceptions must not cross Ceres, which is not exception-safe; they are kept and rethrown later.
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const UnitPoint point = Eigen::Map<const Eigen::VectorXd>(parameters[0], problem_.parameters);
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    try {
      answer(point, r);
      if (jacobians != nullptr && jacobians[0] != nullptr) {
        Eigen::Map<RowMajor> jacobian(jacobians[0], num_residuals(), problem_.parameters);
        differentiate(point, r, jacobian);
      }
    } catch (...) {
      thrown_ = std::current_exception();
      end();
      r.setConstant(penalty());
      if (jacobians != nullptr && jacobians[0] != nullptr) {
        std::fill_n(jacobians[0], num_residuals() * problem_.parameters, 0.0);
      }
    }
    return true;
  }

  /// Residuals of a point; the same penalty in each if it failed or was refused.
  void answer(const UnitPoint& asked, Eigen::Ref<Eigen::VectorXd> residuals) const {
    if (asked.size() == last_.point.size() && asked == last_.point) {
      residuals = last_.residuals;
      return;
    }
    residuals.setConstant(penalty());
    if (!asked.allFinite() || !may_ask(1)) return;
    const UnitPoint point = asked.cwiseMax(0.0).cwiseMin(1.0);
    const Answer answer = problem_.answer({&point, 1}).at(0);
    keep(answer);
    if (!is_feasible(answer)) return;
    residuals = answer.residuals;
    last_ = answer;
    if (answer.good_enough) end();
  }

  void end() const { ended_ = true; }
  bool ended() const { return ended_; }
  const Optimum& run() const { return run_; }
  const std::exception_ptr& thrown() const { return thrown_; }

 private:
  double penalty() const { return std::sqrt(2 * (2 * worst_ + 1) / std::max(1, num_residuals())); }

  bool may_ask(int points) const {
    if (problem_.may_evaluate && !problem_.may_evaluate(points)) end();
    if (run_.evaluations + points > options_.evaluations) end();
    return !ended_;
  }

  void keep(const Answer& answer) const {
    ++run_.evaluations;
    if (is_feasible(answer)) worst_ = std::max(worst_, answer.value);
    if (is_better(answer, run_.best)) run_.best = answer;
  }

  void differentiate(const UnitPoint& point, const Eigen::VectorXd& centre, Eigen::Ref<RowMajor> jacobian) const {
    jacobian.setZero();
    std::vector<Eigen::Index> open(static_cast<std::size_t>(point.size()));
    for (std::size_t k = 0; k < open.size(); ++k) open[k] = static_cast<Eigen::Index>(k);
    // First towards the farther border, where the whole step fits; then alternatives after a failure.
    for (const double share : {1.0, -1.0, 0.25, -0.25}) {
      std::vector<UnitPoint> probes;
      std::vector<Eigen::Index> columns;
      for (const Eigen::Index k : open) {
        const double inward = point[k] <= 0.5 ? 1 : -1;
        UnitPoint probe = point;
        probe[k] = std::clamp(point[k] + inward * share * options_.difference_step, 0.0, 1.0);
        if (std::abs(probe[k] - point[k]) < 0.1 * options_.difference_step) continue;
        probes.push_back(std::move(probe));
        columns.push_back(k);
      }
      if (probes.empty()) continue;
      if (!may_ask(static_cast<int>(probes.size()))) return;
      const std::vector<Answer> answers = problem_.answer(probes);
      for (std::size_t p = 0; p < answers.size(); ++p) {
        const Answer& answer = answers[p];
        keep(answer);
        if (!is_feasible(answer)) continue;
        const Eigen::Index k = columns[p];
        jacobian.col(k) = (answer.residuals - centre) / (answer.point[k] - point[k]);
        std::erase(open, k);
      }
      if (open.empty()) return;
    }
  }

  const Problem& problem_;
  const CeresOptions& options_;
  // Ceres' Evaluate is const; the record is not.
  mutable Optimum run_;
  mutable Answer last_;       // Ceres evaluates an accepted point twice: for the residuals, then for the Jacobian
  mutable double worst_ = 0;  // largest feasible value so far
  mutable bool ended_ = false;
  mutable std::exception_ptr thrown_;
};

/// Ends the solve between iterations.
class Watch : public ceres::IterationCallback {
 public:
  Watch(const Residuals& residuals, const CeresOptions& options) : residuals_(residuals), options_(options) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    const bool within_noise = iteration.step_is_successful && iteration.cost_change <= options_.noise;
    if (iteration.iteration > 0 && (within_noise || iteration.step_norm < options_.step_tolerance)) residuals_.end();
    return residuals_.ended() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const Residuals& residuals_;
  const CeresOptions& options_;
};

void solve(Residuals& residuals, UnitPoint& x, const CeresOptions& options) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&residuals, nullptr, x.data());
  for (int k = 0; k < x.size(); ++k) {
    problem.SetParameterLowerBound(x.data(), k, 0);
    problem.SetParameterUpperBound(x.data(), k, 1);
  }
  Watch watch(residuals, options);
  ceres::Solver::Options solver;
  solver.trust_region_strategy_type =
      options.trust_region == TrustRegion::dogleg ? ceres::DOGLEG : ceres::LEVENBERG_MARQUARDT;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.num_threads = 1;
  solver.max_num_iterations = options.evaluations;
  // Ceres' line search at the bounds would need a Jacobian for every trial.
  solver.max_num_line_search_step_size_iterations = 0;
  solver.initial_trust_region_radius = 10;
  solver.function_tolerance = 1e-9;
  solver.parameter_tolerance = 0.1 * options.step_tolerance;
  solver.logging_type = ceres::SILENT;
  solver.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
}

}  // namespace

std::optional<TrustRegion> trust_region_of(std::string_view strategy) {
  if (strategy == "levenberg_marquardt") return TrustRegion::levenberg_marquardt;
  if (strategy == "dogleg") return TrustRegion::dogleg;
  return std::nullopt;
}

double noise_step(double noise, double curvature) {
  return std::clamp(curvature > 0 ? 2 * std::sqrt(noise / curvature) : 0.5, 0.01, 0.5);
}

Optimum minimise(const Problem& problem, const UnitPoint& start, const CeresOptions& options) {
  const bool inside = start.size() == problem.parameters && (start.array() >= 0).all() && (start.array() <= 1).all();
  if (!inside || problem.residuals < 1)
    throw std::logic_error("minimise: start outside the unit cube, or no residuals");
  Residuals residuals(problem, options);
  Eigen::VectorXd at_start(problem.residuals);
  residuals.answer(start, at_start);
  UnitPoint x = start;
  if (!residuals.ended() && is_feasible(residuals.run().best)) solve(residuals, x, options);
  if (residuals.thrown()) std::rethrow_exception(residuals.thrown());
  return residuals.run();
}

}  // namespace pastefit
