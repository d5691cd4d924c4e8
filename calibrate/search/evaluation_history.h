#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/search/calibration.h"
#include "calibrate/search/candidate_queue.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// All requests and answers of a search. It reserves the simulations of the next confirmation and reports progress.
///
/// Each residual is divided by sqrt(1 + v/m), which gives noisy readings less weight; v: its variance between packings
/// in squared standard deviations of the measurement, m: number of common packings. v is the typical variance
/// (`typical_variance`) of the candidates that ran on several packings. With the mean variance, a few candidates that
/// keep their shape on some packings and shear off on others would suppress every reading. The weights change only
/// between phases, so that an optimiser's objective is constant.
class EvaluationHistory {
 public:
  /// `earlier`: responses known at the start, each on one packing.
  EvaluationHistory(CandidateQueue& queue, std::span<const Response> earlier, const SearchOptions& options,
                    const std::function<void(const Progress&)>& progress);

  const Scoring& scoring() const { return queue_.scoring(); }
  int parameters() const { return scoring().parameters(); }
  int residuals() const { return scoring().residuals(); }
  int readings() const { return scoring().readings(); }
  double tolerance(std::size_t reading) const { return scoring().tolerance(reading); }
  double allowance(std::size_t reading) const;
  /// Allowance of each residual; 0 for priors.
  Eigen::VectorXd allowances() const;
  /// Misfit of a candidate whose fitted readings all differ by their tolerance.
  double allowed_misfit() const;
  bool stop_requested() const { return queue_.stop_requested(); }
  int budget_left() const;  ///< points on a packing, less those reserved or pending

  /// Requests all points on all these packings: completely, possibly stopped early (`try_out`), or with coarse grains.
  /// The answers are available when the phase is called again. Requirement: no request is open.
  void evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) {
    await(points, packings, Fidelity::fine, false);
  }
  void try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) {
    await(points, packings, Fidelity::fine, true);
  }
  /// The answers go to `coarse_singles`, weighted as those of fine grains.
  void evaluate_coarse(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) {
    await(points, packings, Fidelity::coarse, false);
  }
  bool is_waiting() const { return awaited_ && !queue_.is_answered(awaited_->numbers); }
  /// Takes the answers to the open request, if any. Requirement: not `is_waiting()`.
  void take_answers();
  /// Answers taken last, in the order of the points; fine grains only.
  const std::vector<Response>& answers() const { return answers_; }

  /// Response of a point to packings on which it was simulated completely; simulates nothing.
  Response recall(const UnitPoint& point, std::span<const std::uint64_t> packings);

  /// Enqueues a point that may end early without waiting; its simulations count as spent from now on.
  void begin(const UnitPoint& point, std::uint64_t packing);
  /// Requests the earliest pending point, even if later ones have finished.
  void await_next();
  /// Pending points, earliest first, with their packing.
  struct Asked {
    UnitPoint point;
    std::uint64_t packing = 0;
  };
  const std::deque<Asked>& under_way() const { return under_way_; }

  void hold_back(int packings) { held_back_ = packings; }
  /// Begins a phase and updates the weights of all residuals.
  void enter(std::string_view phase);
  /// Reports a message to the caller.
  void say(const std::string& note) const { report(note); }

  /// Best complete response: on exactly these packings if any, else on any, else on one; without point if none.
  Response best(std::span<const std::uint64_t> packings) const;
  const std::vector<Response>& responses() const { return responses_; }
  const std::vector<Response>& singles() const { return singles_; }  ///< each on one packing, earlier ones too
  const std::vector<Response>& coarse_singles() const { return coarse_singles_; }
  /// Data for the surrogate: fine simulations and corrected coarse ones.
  std::vector<Response> training_data() const;
  /// Best known starting point: on these packings if any, else on others.
  UnitPoint best_point(std::span<const std::uint64_t> packings) const;
  int simulations() const { return (at_start_ - queue_.budget_left()) * scoring().simulations_each(); }
  bool any_feasible() const;

 private:
  /// Open request.
  struct Awaited {
    std::vector<std::size_t> numbers;  // of the candidates, point by point
    std::size_t packings = 0;          // of each point
    Fidelity fidelity = Fidelity::fine;
  };
  void await(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings, Fidelity fidelity,
             bool may_end_early);
  std::vector<Response> responses_to(const Awaited& awaited);
  void note(std::span<const Response> answered);
  /// Best complete response on exactly these packings; without point if none.
  Response best_on(std::span<const std::uint64_t> packings) const;
  void keep_singles(std::span<const Response> responses, std::size_t packings, std::vector<Response>& singles);
  static void keep_single(const Response& response, std::vector<Response>& singles);
  /// Multiplies the residuals of a feasible response by `factors`; none if empty.
  static void weigh(Response& response, const Eigen::VectorXd& factors);
  void measure_noise();
  /// Variance of each weighted residual; empty if no point has two packings.
  Eigen::ArrayXd variance_between_packings() const;
  void report(const std::string& note = {}) const;

  CandidateQueue& queue_;
  const std::function<void(const Progress&)>& progress_;
  int at_start_ = 0;
  int budget_ = 0;
  int held_back_ = 0;
  std::string phase_;
  double best_error_ = -1;
  std::size_t best_packings_ = 0;  // responses on more packings take precedence
  double common_packings_ = 1;
  Eigen::VectorXd factors_;  // of the residuals; empty: 1
  std::deque<Asked> under_way_;
  std::optional<Awaited> awaited_;
  std::vector<Response> answers_;
  std::vector<Response> responses_;
  std::vector<Response> singles_;
  std::vector<Response> coarse_singles_;
};

/// Range of each reading over the simulations. `coarse`: corrected simulations with coarse grains, whose residuals
/// count for `all_above` and `all_below`.
std::vector<Reach> reach_of(std::span<const Response> singles, std::span<const double> allowances,
                            std::span<const Response> coarse = {});

}  // namespace pastefit
