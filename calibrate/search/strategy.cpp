#include "calibrate/search/strategy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "calibrate/optimisers/ceres.h"
#include "calibrate/optimisers/nlopt.h"
#include "calibrate/search/archive.h"
#include "calibrate/search/coarse_rung.h"
#include "calibrate/search/conclusion.h"
#include "calibrate/search/confirmation.h"
#include "calibrate/search/proposals.h"
#include "calibrate/search/prospects.h"
#include "calibrate/search/reachability.h"
#include "calibrate/search/screening.h"
#include "calibrate/search/simulated_problem.h"

namespace pastefit {
namespace {

constexpr double goal_share = 0.6;     // of the tolerances: what a candidate should be within, to be confirmed
constexpr double hardly_likely = 0.1;  // its probability with which a confirmation is broken off
constexpr double likely_enough = 0.5;  // and with which it is begun

/// Or with which all is within the tolerances. A shift of the top is never 0: good heaps have 30 mm of the 40 allowed,
/// and a search that waited to be all but certain (0.97) simulated mix 79 two hundred times more; to ask takes 8.
constexpr double likely_to_hold = 0.75;
constexpr std::size_t most_confirmations = 8;  // the fresh packings grow to so many times what the study asks for

/// The strategy's state; each phase is one function.
class Strategy {
 public:
  Strategy(CandidateQueue& queue, const SearchOptions& options, const SearchStart& start,
           const std::function<void(const Progress&)>& progress)
      : scoring_(queue.scoring()),
        options_(options),
        with_coarse_(start.with_coarse && find_strategy(options.strategy)->kind == StrategyKind::surrogate),
        archive_(queue, start.earlier, options, progress),
        readings_(start.readings),
        parameters_(start.parameters) {}

  Calibration run() {
    common_ = fresh_packings(options_.packings);
    archive_.hold_back(options_.confirmation_packings);
    if (with_coarse_) screen_coarsely();
    if (archive_.evidence().empty()) screen();
    if (!archive_.singles().empty() && is_out_of_reach()) {
      archive_.evaluate({&out_of_reach_->nearest, 1}, common_);
      if (!archive_.stop_requested() && prospects().best().size() > 0) confirm();
      if (archive_.stop_requested() || confirmed_ || claim_stands()) return conclude();
    }
    searched_ = true;
    while (any_evidence() && may_go_on()) {
      if (!look_for_candidate()) break;
      refine();
      if (archive_.stop_requested() || confirm()) break;
    }
    return conclude();
  }

 private:
  /// Packing seeds that no simulation of this search has used.
  std::vector<std::uint64_t> fresh_packings(int count) {
    std::vector<std::uint64_t> packings;
    for (int k = 0; k < count; ++k) packings.push_back(options_.seed * 1000 + ++packings_used_);
    return packings;
  }

  bool affordable(std::size_t packings) const { return archive_.budget_left() >= static_cast<int>(packings); }
  bool may_go_on() const { return !archive_.stop_requested() && affordable(common_.size()); }

  void screen_coarsely() {
    archive_.enter("screening");
    const auto points = screening_points(scoring_.parameters(), options_.screening, options_.seed);
    archive_.evaluate_coarse(points, packings_of_coarse(options_.seed, 1));
  }

  bool any_evidence() const {
    return std::ranges::any_of(archive_.evidence(), [](const Response& one) { return is_feasible(one); });
  }

  void screen() {
    archive_.enter("screening");
    const std::span<const std::uint64_t> first(common_.data(), 1);
    const int known = static_cast<int>(archive_.singles().size());
    int asked = 0;
    // If everything fails, further points of the same sequence look elsewhere, while half of the budget lasts.
    while ((!archive_.any_feasible() || known + asked < options_.screening) && !archive_.stop_requested()) {
      const int missing = options_.screening - (archive_.any_feasible() ? known + asked : 0);
      const int count = std::min(missing, archive_.budget_left());
      if (count < 1 || asked > options_.budget_simulations / scoring_.simulations_each() / 2) return;
      const auto points = screening_points(scoring_.parameters(), asked + count, options_.seed);
      archive_.try_out(std::span(points).last(static_cast<std::size_t>(count)), first);
      asked += count;
    }
  }

  /// Says what the screening tells of the reach, and whether a search would be in vain.
  bool is_out_of_reach() {
    if (!archive_.any_feasible() || archive_.stop_requested()) return false;
    const int spare = archive_.budget_left() - static_cast<int>(common_.size());
    out_of_reach_ = find_out_of_reach(archive_, {common_.front(), std::min(options_.screening, spare)});
    if (archive_.stop_requested()) return false;
    archive_.say(out_of_reach_ ? words_of(*out_of_reach_, readings_, parameters_)
                               : words_of_screening(archive_.singles(), readings_));
    return out_of_reach_.has_value();
  }

  /// Asks again what was said to be out of reach, by all that was simulated since; withdraws it if it is not.
  bool claim_stands() {
    const auto against = [&](const Response& one) { return contradicts(one, *out_of_reach_); };
    const auto contradiction = std::ranges::find_if(archive_.singles(), against);
    if (contradiction == archive_.singles().end()) {
      if (const auto again = known_out_of_reach(archive_, ReachOf::simulations);
          again && again->reading == out_of_reach_->reading) {
        out_of_reach_ = again;
        return true;
      }
    }
    archive_.say(words_of_withdrawal(*out_of_reach_, readings_));
    out_of_reach_.reset();
    return false;
  }

  Prospects prospects() const { return {archive_, refuted_}; }

  /// True if the best candidate is more likely than not to do.
  bool goal_is_met(const Prospects& prospects) const {
    if (prospects.best().size() == 0) return false;
    return prospects.chance_of(prospects.best(), goal_share) >= likely_enough ||
           prospects.chance_of(prospects.best(), 1) >= likely_to_hold;
  }

  /// The miss at which an optimiser may end by itself; none where what is known beforehand has a say.
  double optimisers_goal() const { return scoring_.residuals() > scoring_.readings() ? 0 : goal_share; }

  /// Brings candidates on the common packings; false if not a single one could be had.
  bool look_for_candidate() {
    archive_.enter("search");
    switch (find_strategy(options_.strategy)->kind) {
      case StrategyKind::surrogate:
        propose_and_try();
        break;
      case StrategyKind::ceres:
        descend(*trust_region_of(options_.strategy), archive_.best_point(common_), share_of_budget());
        break;
      case StrategyKind::nlopt:
        minimise_misfit();
        break;
    }
    return prospects().best().size() > 0;
  }

  /// Half of what is left, in points on all common packings.
  int share_of_budget() const { return std::max(1, archive_.budget_left() / static_cast<int>(2 * common_.size())); }

  void minimise_misfit() {
    NloptOptions nlopt;
    nlopt.algorithm = options_.strategy;
    nlopt.evaluations = share_of_budget();
    nlopt.step_tolerance = same_point;
    nlopt.seed = options_.seed;
    (void)minimise(simulated_problem(archive_, common_, optimisers_goal()), archive_.best_point(common_), nlopt);
  }

  /// Proposes, and takes the answers in the order of the proposals, until a candidate is likely to do. Proposal k knows
  /// the answers up to k - 1 - lag, of the others only that they were asked: what is ready first does not matter.
  void propose_and_try() {
    Proposals proposals(archive_, with_coarse_, options_);
    while (true) {
      const Prospects known = prospects();
      const bool enough = goal_is_met(known);
      while (!enough && may_go_on() && std::ssize(archive_.under_way()) <= options_.lag) {
        const std::optional<UnitPoint> proposal = proposals.next(known);
        if (!proposal) break;
        archive_.begin(*proposal, packing_for(*proposal));
      }
      if (archive_.under_way().empty()) return;
      const Response response = archive_.next_answer();
      // What it misses at least does not rule it out: its other readings decide.
      if (is_feasible(response) && response.ended_early && response.misfit < known.misfit_of_best() && may_go_on())
        (void)archive_.evaluate({&response.point, 1}, response.packings);
    }
  }

  /// One of the common packings in turn; a fresh one for a point that has been simulated on all of them.
  std::vector<std::uint64_t> packing_for(const UnitPoint& point) {
    const std::size_t turn = archive_.history().size() + archive_.under_way().size();
    for (std::size_t k = 0; k < common_.size(); ++k) {
      const std::uint64_t packing = common_[(turn + k) % common_.size()];
      const auto known = [&](const Response& one) { return one.point == point && one.packings.front() == packing; };
      if (std::ranges::none_of(archive_.singles(), known)) return {packing};
    }
    return fresh_packings(1);
  }

  /// Misfit that the noise of the packings makes by itself on the common set, as far as it is known.
  double noise() const {
    double squares = 0;
    int freedom = 0;
    const auto& singles = archive_.singles();
    for (std::size_t i = 0; i < singles.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (!is_whole(singles[i]) || !is_whole(singles[j]) || singles[i].point != singles[j].point) continue;
        squares += (singles[i].residuals - singles[j].residuals).squaredNorm() / 2;
        ++freedom;
      }
    }
    return freedom > 0 ? 0.5 * squares / freedom / static_cast<double>(common_.size()) : 0;
  }

  /// Probe for Ceres: long enough to show against the noise. A residual that goes through its range once, saturated at
  /// both ends, has a curvature of about four times the range.
  double probe_length() const {
    const double infinity = std::numeric_limits<double>::infinity();
    Eigen::ArrayXd least = Eigen::ArrayXd::Constant(scoring_.residuals(), infinity), most = -least;
    for (const Response& single : archive_.evidence()) {
      if (!is_feasible(single)) continue;
      least = least.min(single.residuals.array());
      most = most.max(single.residuals.array());
    }
    const double deviation = std::sqrt(2 * noise() / scoring_.residuals());
    return noise_step(deviation, 4 * (most - least).maxCoeff());
  }

  /// Descends where the surrogate sees no better candidate and none that will do, unless what is left is luck.
  void refine() {
    if (!may_go_on() || noise() > archive_.allowed_misfit()) return;
    const Prospects known = prospects();
    if (goal_is_met(known)) return;
    archive_.enter("refinement");
    descend(TrustRegion::levenberg_marquardt, known.best(), CeresOptions{}.evaluations);
  }

  void descend(TrustRegion trust_region, const UnitPoint& start, int evaluations) {
    CeresOptions ceres;
    ceres.trust_region = trust_region;
    ceres.evaluations = evaluations;
    ceres.difference_step = probe_length();
    ceres.step_tolerance = same_point;
    ceres.noise = noise();
    (void)minimise(simulated_problem(archive_, common_, optimisers_goal()), start, ceres);
  }

  /// Asks the candidate on fresh packings, and on as many again while their noise hides the answer; true if it holds. A
  /// quarter of them is asked first: if it is unlikely then that it will do, the others are saved.
  bool confirm() {
    archive_.enter("confirmation");
    archive_.hold_back(0);
    const UnitPoint candidate = prospects().best();
    const auto all = static_cast<std::size_t>(options_.confirmation_packings);
    std::vector<std::uint64_t> fresh = fresh_packings(static_cast<int>((all + 3) / 4));
    Response confirmation = archive_.evaluate({&candidate, 1}, fresh).at(0);
    Verdict verdict = Verdict::undecided;
    if (!out_of_reach_ && prospects().chance_of(candidate, 1) < hardly_likely) verdict = Verdict::refuted;
    while (verdict == Verdict::undecided && fresh.size() < most_confirmations * all && !archive_.stop_requested()) {
      const std::size_t more = fresh.size() < all ? all - fresh.size() : fresh.size();
      if (!affordable(more)) break;
      std::ranges::copy(fresh_packings(static_cast<int>(more)), std::back_inserter(fresh));
      confirmation = archive_.evaluate({&candidate, 1}, fresh).at(0);
      verdict = verdict_on(confirmation, scoring_.rejected_share());
      if (packings_to_decide(confirmation) > most_confirmations * static_cast<double>(all)) break;
    }
    if (archive_.stop_requested()) return false;
    ++result_.rounds;
    confirmed_ = verdict == Verdict::holds;
    if (!confirmed_) refuted_.push_back(candidate);
    report(confirmation);
    archive_.hold_back(options_.confirmation_packings);
    return confirmed_;
  }

  /// The result is this candidate, judged on fresh packings, if no better one was.
  void report(const Response& confirmation) {
    std::vector<std::uint64_t> tried;  // before it was judged
    for (const Response& one : archive_.singles())
      if (one.point == confirmation.point && is_whole(one) &&
          std::ranges::count(confirmation.packings, one.packings.front()) == 0)
        tried.push_back(one.packings.front());
    std::vector<std::uint64_t> joined = tried;
    std::ranges::copy(confirmation.packings, std::back_inserter(joined));
    const Response evidence = archive_.recall(confirmation.point, joined);
    const bool first = result_.confirmation.point.size() == 0 || result_.confirmation.point == confirmation.point;
    if (!confirmed_ && !first && !is_better(evidence, result_.best)) return;
    result_.best = evidence;
    result_.search = archive_.recall(confirmation.point, tried);
    result_.confirmation = confirmation;
  }

  /// The confirmation that is reported was broken off: the rest of its packings, if the budget has them. They may prove
  /// wrong what broke it off.
  void finish_confirmation() {
    archive_.hold_back(0);
    std::vector<std::uint64_t> fresh = result_.confirmation.packings;
    const auto all = static_cast<std::size_t>(options_.confirmation_packings);
    if (fresh.empty() || fresh.size() >= all || !affordable(all - fresh.size()) || archive_.stop_requested()) return;
    const UnitPoint candidate = result_.confirmation.point;
    std::ranges::copy(fresh_packings(static_cast<int>(all - fresh.size())), std::back_inserter(fresh));
    const Response confirmation = archive_.evaluate({&candidate, 1}, fresh).at(0);
    if (archive_.stop_requested()) return;
    confirmed_ = verdict_on(confirmation, scoring_.rejected_share()) == Verdict::holds;
    report(confirmation);
  }

  Calibration conclude() {
    finish_confirmation();
    if (result_.best.point.size() == 0 && archive_.any_feasible()) {
      result_.search = archive_.best_on(common_).value_or(Response{});
      if (result_.search.point.size() == 0)
        for (const Response& seen : archive_.history())
          if (is_whole(seen) && is_better(seen, result_.search)) result_.search = seen;
      if (result_.search.point.size() == 0) result_.search = archive_.best_single().value_or(Response{});
      result_.best = result_.search;
    }
    result_.history = archive_.history();
    result_.simulations = archive_.simulations();
    result_.coarse_simulations = static_cast<int>(archive_.coarse_singles().size());
    result_.failures = archive_.failures();
    std::vector<double> allowances;
    for (std::size_t k = 0; std::ssize(allowances) < scoring_.readings(); ++k)
      allowances.push_back(scoring_.allowance(k));
    result_.reach = reach_of(archive_.singles(), allowances);
    for (const Response& coarse : corrected(archive_.coarse_singles(), archive_.singles())) {
      for (std::size_t k = 0; k < result_.reach.size(); ++k) {
        Reach& reach = result_.reach[k];
        const double residual = coarse.residuals[static_cast<Eigen::Index>(k)];
        reach.all_above = reach.all_above && residual > allowances[k];
        reach.all_below = reach.all_below && residual < -allowances[k];
      }
    }
    Ending ending{confirmed_, archive_.stop_requested(), archive_.any_feasible(), with_coarse_, searched_};
    if (!confirmed_ && !ending.stopped)
      ending.out_of_reach = searched_ ? known_out_of_reach(archive_, ReachOf::means) : out_of_reach_;
    ending.some_ended_early = std::ranges::any_of(archive_.singles(), &Response::ended_early);
    ending.rejected_share = scoring_.rejected_share();
    explain(result_, ending, scoring_.misfit_unit(), readings_, parameters_);
    return std::move(result_);
  }

  const Scoring& scoring_;
  const SearchOptions& options_;
  bool with_coarse_;
  Archive archive_;
  std::span<const std::string> readings_, parameters_;
  std::optional<OutOfReach> out_of_reach_;
  bool searched_ = false;              // a search was begun
  std::vector<std::uint64_t> common_;  // every candidate is compared on these
  std::vector<UnitPoint> refuted_;     // candidates that a confirmation has judged
  std::uint64_t packings_used_ = 0;
  bool confirmed_ = false;
  Calibration result_;
};

}  // namespace

Calibration run_strategy(CandidateQueue& queue, const SearchOptions& options, const SearchStart& start,
                         const std::function<void(const Progress&)>& progress) {
  return Strategy(queue, options, start, progress).run();
}

}  // namespace pastefit
