#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/answers.h"
#include "calibrate/evaluate/simulation_pool.h"
#include "tests/calibrate/search/objective.h"

namespace pastefit {

/// A study whose candidates a pool simulates, by calls that wait: for parts of a calibration by themselves.
class SimulationObjective : public Objective, public StudyScoring {
 public:
  SimulationObjective(const Study& study, Store& store, const PoolOptions& options, int budget = 0)
      : StudyScoring(study),
        study_(std::shared_ptr<void>(), &study),
        answers_(study_, store, ""),
        budget_(budget > 0 ? budget : study.search.budget_simulations),
        pool_(store, options) {}

  int budget_left() const override { return simulations_left() / simulations_each(); }
  int simulations_left() const override { return std::max(0, budget_ - static_cast<int>(asked_.size())); }
  std::vector<Response> earlier() const override { return answers_.earlier(); }
  bool stop_requested() const override { return pool_.stop_requested(); }
  EvaluationCounts counts() const { return counts_; }

  void begin(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings, bool tried) override {
    for (const UnitPoint& point : points)
      for (const std::uint64_t packing : packings)
        for (const Simulation& one : simulations(point, packing, tried)) (void)run_of(one);
  }
  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override {
    return responses_to(points, packings, false);
  }
  std::vector<Response> try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override {
    return responses_to(points, packings, true);
  }
  /// Evaluates a candidate in one test, fitted or not, on each packing.
  std::vector<StoredEvaluation> predict(const UnitPoint& point, std::span<const std::uint64_t> packings,
                                        std::size_t test) {
    std::vector<StoredEvaluation> out;
    for (const std::uint64_t packing : packings) (void)run_of({0, study_, test, point, packing, false, ""});
    for (const std::uint64_t packing : packings)
      out.push_back(answer_to({0, study_, test, point, packing, false, ""}).first);
    return out;
  }

 private:
  using Key = std::pair<std::string, bool>;

  std::vector<Simulation> simulations(const UnitPoint& point, std::uint64_t packing, bool tried) const {
    return answers_.simulations_of({0, point, packing, Fidelity::fine, tried, ""});
  }
  Key key(const Simulation& one) const { return {answers_.unanswered(one).key, one.may_end_early}; }

  /// Null: it was known.
  std::shared_ptr<SimulationPool::Run> run_of(const Simulation& one) {
    const Key of_it = key(one);
    if (const auto begun = runs_.find(of_it); begun != runs_.end()) return begun->second;
    return runs_[of_it] = answers_.find(one) ? nullptr : pool_.begin(one, !one.may_end_early);
  }

  /// The answer, and whether it counts in the budget from now on.
  std::pair<StoredEvaluation, bool> answer_to(const Simulation& one) {
    const auto run = run_of(one);
    const auto finished = run ? SimulationPool::wait(*run) : std::nullopt;
    auto known = answers_.find(one);
    if (!known) {
      known = answers_.unanswered(one);
      known->failure.emplace().reason = FailureReason::stopped;
      return {*known, false};
    }
    const bool fresh = asked_.insert(finished ? finished->key : key(one).first).second;
    if (fresh) {
      ++(run ? counts_.simulated : counts_.answered);
      if (const auto failure = answers_.failure_of(one, *known)) ++counts_.failures[failure->reason];
    }
    return {*known, fresh};
  }

  std::vector<Response> responses_to(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                     bool tried) {
    begin(points, packings, tried);
    std::vector<Response> responses;
    for (const UnitPoint& point : points) {
      std::vector<Evaluation> evaluations;
      for (const std::uint64_t packing : packings) evaluations.push_back(evaluate(point, packing, tried));
      responses.push_back(response_of(std::move(evaluations)));
      const Response& last = responses.back();
      if (!last.failed && !last.censored && (counts_.best_error < 0 || last.error < counts_.best_error))
        counts_.best_error = last.error;
    }
    return responses;
  }

  Evaluation evaluate(const UnitPoint& point, std::uint64_t packing, bool tried) {
    const auto asked = simulations(point, packing, tried);
    std::vector<StoredEvaluation> answers;
    int fresh = 0;
    for (const Simulation& one : asked) {
      auto [answer, counts] = answer_to(one);
      fresh += counts ? 1 : 0;
      answers.push_back(std::move(answer));
    }
    Evaluation out = answers_.evaluation_of(asked, answers);
    out.simulations = fresh;
    return out;
  }

  const std::shared_ptr<const Study> study_;
  const StudyAnswers answers_;
  const int budget_;
  std::map<Key, std::shared_ptr<SimulationPool::Run>> runs_;
  std::set<std::string> asked_;
  EvaluationCounts counts_;
  SimulationPool pool_;
};

}  // namespace pastefit
