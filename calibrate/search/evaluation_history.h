#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "calibrate/search/calibration.h"
#include "calibrate/search/candidate_queue.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// All that was asked and answered: it keeps every answer, holds back the simulations of the next confirmation, and
/// tells the caller where the search is.
///
/// Residuals are weighted by the noise of the packings as well as by the laboratory's own deviation: each is divided by
/// sqrt(1 + v/m), v its variance from packing to packing in squared standard deviations of the laboratory, m the common
/// packings. A reading that wobbles says less. v is the typical one (`typical_variance`) of the candidates that ran on
/// several packings: those that stand or shear off by luck would say that no reading matters. It changes only between
/// phases, so that an optimiser's objective stays the same while it runs.
class EvaluationHistory {
 public:
  /// `earlier`: what is known from the start, each point on one packing.
  EvaluationHistory(CandidateQueue& queue, std::span<const Response> earlier, const SearchOptions& options,
                    const std::function<void(const Progress&)>& progress);

  const Scoring& scoring() const { return queue_.scoring(); }
  int parameters() const { return scoring().parameters(); }
  int residuals() const { return scoring().residuals(); }
  int readings() const { return scoring().readings(); }
  double tolerance(std::size_t reading) const { return scoring().tolerance(reading); }
  double allowance(std::size_t reading) const;
  /// Of each residual; 0 of those that are no reading.
  Eigen::VectorXd allowances() const;
  /// The misfit of a candidate each of whose fitted readings is off by its tolerance.
  double allowed_misfit() const;
  bool stop_requested() const { return queue_.stop_requested(); }
  int budget_left() const;  ///< points on a packing, without what is held back or under way

  /// Asks for points on the same packings, which run to their end, or may end early, or are of coarse grains. A phase
  /// asks, goes back to its caller, and finds the answers when it is called again. Requirement: nothing is awaited.
  void evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings);
  void try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings);
  /// The answers are in `coarse_singles`, weighed as all others.
  void evaluate_coarse(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings);
  /// Whether something is awaited that is not answered yet.
  bool is_waiting() const { return awaited_ && !queue_.is_answered(awaited_->numbers); }
  /// Takes the answers to what was awaited, if anything was. Requirement: not `is_waiting()`.
  void take_answers();
  /// The answers taken last, in the order of the points; none of coarse grains.
  const std::vector<Response>& answers() const { return answers_; }

  /// The answer of a point on packings on each of which it was simulated to its end; starts nothing.
  Response recall(const UnitPoint& point, std::span<const std::uint64_t> packings);

  /// Begins to work on a point that may end early, and goes on without its answer; its simulations are spent from now
  /// on.
  void begin(const UnitPoint& point, std::span<const std::uint64_t> packings);
  /// Awaits the earliest point that is under way: answers come in the order of asking, whichever is ready first.
  void await_next();
  /// Points begun and not yet answered, the earliest first, each with its packings.
  struct Asked {
    UnitPoint point;
    std::vector<std::uint64_t> packings;
  };
  const std::deque<Asked>& under_way() const { return under_way_; }

  void hold_back(int packings) { held_back_ = packings; }
  /// Begins a phase: weighs anew all that was answered.
  void enter(std::string_view phase);
  /// Tells whoever waits.
  void say(const std::string& note) const { report(note); }

  /// Best answer on exactly these packings; one that has all its readings.
  std::optional<Response> best_on(std::span<const std::uint64_t> packings) const;
  /// Best answer of a point on one packing; one that has all its readings.
  std::optional<Response> best_single() const;
  const std::vector<Response>& responses() const { return responses_; }
  const std::vector<Response>& singles() const { return singles_; }  ///< each point on each packing, earlier ones too
  const std::vector<Response>& coarse_singles() const { return coarse_singles_; }
  /// What a surrogate learns from: the simulations, and the coarse ones as far as they tell of them.
  std::vector<Response> training_data() const;
  /// The best starting point known: on these packings, else on whatever others.
  UnitPoint best_point(std::span<const std::uint64_t> packings) const;
  int simulations() const { return (at_start_ - queue_.budget_left()) * scoring().simulations_each(); }
  int failures() const;
  bool any_feasible() const;

 private:
  /// What a phase waits for.
  struct Awaited {
    std::vector<std::size_t> numbers;  // of the candidates, point by point
    std::size_t packings = 0;          // each point on so many
    Fidelity fidelity = Fidelity::fine;
  };
  void await(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings, Fidelity fidelity,
             bool may_end_early);
  std::vector<Response> responses_to(const Awaited& awaited);
  void keep(std::span<const Response> responses, std::size_t packings);
  void note(std::span<const Response> answered);
  static void keep_single(const Response& response, std::vector<Response>& singles);
  void weigh(Response& response) const;
  void measure_noise();
  /// Of each residual as it is weighed now; empty if no point has been simulated twice.
  Eigen::ArrayXd variance_between_packings() const;
  void report(const std::string& note = {}) const;

  CandidateQueue& queue_;
  const std::function<void(const Progress&)>& progress_;
  int at_start_ = 0;
  int budget_ = 0;
  int held_back_ = 0;
  std::string_view phase_;
  double best_error_ = -1;
  std::size_t best_packings_ = 0;  // a misfit on more packings says more than one on fewer
  double common_packings_ = 1;
  Eigen::VectorXd factors_;  // of the residuals; empty: all 1
  std::deque<Asked> under_way_;
  std::optional<Awaited> awaited_;
  std::vector<Response> answers_;
  std::vector<Response> responses_;
  std::vector<Response> singles_;
  std::vector<Response> coarse_singles_;
};

/// What the simulations did with each reading.
std::vector<Reach> reach_of(std::span<const Response> singles, std::span<const double> allowances);

}  // namespace pastefit
