#include "calibrate/search/evaluation_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "calibrate/base/statistics.h"
#include "calibrate/search/surrogate.h"

namespace pastefit {

namespace {

/// True if a stop may have cut off a response: it counts as failed but carries no information about the point.
bool is_cut_off(const Response& response) {
  return std::ranges::any_of(response.evaluations, [](const Evaluation& one) {
    return one.failure && one.failure->reason == FailureReason::stopped;
  });
}

/// Best of the responses that count; without point if none does.
template <class Counts>
Response best_of(std::span<const Response> responses, const Counts& counts) {
  Response best;
  for (const Response& one : responses)
    if (counts(one) && is_better(one, best)) best = one;
  return best;
}

}  // namespace

EvaluationHistory::EvaluationHistory(CandidateQueue& queue, std::span<const Response> earlier,
                                     const SearchOptions& options, const std::function<void(const Progress&)>& progress)
    : queue_(queue), progress_(progress), at_start_(queue.budget_left()), common_packings_(options.packings) {
  budget_ = std::min(options.budget_simulations / scoring().simulations_each(), at_start_);
  for (const Response& response : earlier) keep_single(response, singles_);
}

int EvaluationHistory::budget_left() const {
  const int spent = at_start_ - queue_.budget_left() + static_cast<int>(under_way_.size());
  return std::max(0, budget_ - spent - held_back_);
}

void EvaluationHistory::begin(const UnitPoint& point, std::uint64_t packing) {
  (void)queue_.ask({&point, 1}, {&packing, 1}, Fidelity::fine, true);
  under_way_.push_back({point, packing});
}

void EvaluationHistory::await_next() {
  const Asked asked = std::move(under_way_.front());
  under_way_.pop_front();
  try_out({&asked.point, 1}, {&asked.packing, 1});
}

void EvaluationHistory::await(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                              Fidelity fidelity, bool may_end_early) {
  awaited_ = {queue_.ask(points, packings, fidelity, may_end_early), packings.size(), fidelity};
}

void EvaluationHistory::take_answers() {
  if (!awaited_) return;
  const Awaited awaited = std::move(*awaited_);
  awaited_.reset();
  std::vector<Response> responses = responses_to(awaited);
  if (awaited.fidelity == Fidelity::fine) {
    answers_ = std::move(responses);
    keep_singles(answers_, awaited.packings, singles_);
    note(answers_);
  } else if (!stop_requested()) {
    keep_singles(responses, awaited.packings, coarse_singles_);
    report();
  }
}

std::vector<Response> EvaluationHistory::responses_to(const Awaited& awaited) {
  std::vector<Response> responses;
  const std::vector<Evaluation> answers = queue_.answers(awaited.numbers);
  for (auto next = answers.begin(); next != answers.end(); next += static_cast<std::ptrdiff_t>(awaited.packings)) {
    responses.push_back(scoring().response_of({next, next + static_cast<std::ptrdiff_t>(awaited.packings)}));
    weigh(responses.back(), factors_);
  }
  return responses;
}

/// Keeps single simulations, packing by packing.
void EvaluationHistory::keep_singles(std::span<const Response> responses, std::size_t packings,
                                     std::vector<Response>& singles) {
  for (std::size_t k = 0; k < packings; ++k)
    for (const Response& response : responses) {
      Response one = scoring().response_of({response.evaluations[k]});
      if (stop_requested() && is_cut_off(one)) continue;
      weigh(one, factors_);
      keep_single(one, singles);
    }
}

Response EvaluationHistory::recall(const UnitPoint& point, std::span<const std::uint64_t> packings) {
  std::vector<Evaluation> evaluations;
  for (const std::uint64_t packing : packings)
    for (const Response& one : singles_)
      if (one.point == point && one.packings.front() == packing) evaluations.push_back(one.evaluations.front());
  if (evaluations.size() != packings.size()) throw std::logic_error("recall: a point that was not simulated there");
  Response response = scoring().response_of(std::move(evaluations));
  weigh(response, factors_);
  note({&response, 1});
  return response;
}

void EvaluationHistory::note(std::span<const Response> answered) {
  for (const Response& response : answered) {
    if (stop_requested() && is_cut_off(response)) continue;
    responses_.push_back(response);
    if (!is_whole(response) || response.packings.size() < best_packings_) continue;
    if (response.packings.size() > best_packings_ || response.error < best_error_) {
      best_error_ = response.error;
      best_packings_ = response.packings.size();
    }
  }
  report();
}

void EvaluationHistory::enter(std::string_view phase) {
  phase_ = phase;
  queue_.enter(phase);
  measure_noise();
  report();
}

double EvaluationHistory::allowance(std::size_t reading) const {
  const double factor = factors_.size() == 0 ? 1 : factors_[reading];
  return factor * scoring().allowance(reading);
}

Eigen::VectorXd EvaluationHistory::allowances() const {
  Eigen::VectorXd allowances = Eigen::VectorXd::Zero(residuals());
  for (int k = 0; k < readings(); ++k) allowances[k] = allowance(k);
  return allowances;
}

double EvaluationHistory::allowed_misfit() const {
  return 0.5 * allowances().squaredNorm();
}

void EvaluationHistory::weigh(Response& response, const Eigen::VectorXd& factors) {
  if (factors.size() == 0 || !is_feasible(response)) return;
  response.residuals.array() *= factors.array();
  response.misfit = 0.5 * response.residuals.squaredNorm();
}

Eigen::ArrayXd EvaluationHistory::variance_between_packings() const {
  constexpr double most = 4;  // largest weight of a candidate: a candidate that shears off on some packings has many
  std::vector<std::vector<WeighedSquare>> squares(residuals());
  for (std::size_t i = 0; i < singles_.size(); ++i) {
    if (!is_whole(singles_[i])) continue;
    const auto is_same = [&](const Response& one) { return is_whole(one) && one.point == singles_[i].point; };
    const auto packings = static_cast<double>(std::ranges::count_if(singles_, is_same));
    const double weight = std::min(packings - 1, most) / (packings * (packings - 1) / 2);
    for (std::size_t j = 0; j < i; ++j)
      if (is_same(singles_[j]))
        for (std::size_t k = 0; k < squares.size(); ++k) {
          const double difference = singles_[i].residuals[k] - singles_[j].residuals[k];
          squares[k].push_back({difference * difference / 2, weight});
        }
  }
  if (squares.front().empty()) return {};
  Eigen::ArrayXd variance(residuals());
  for (std::size_t k = 0; k < squares.size(); ++k) variance[k] = typical_variance(squares[k]);
  return variance;
}

void EvaluationHistory::measure_noise() {
  Eigen::ArrayXd variance = variance_between_packings();
  if (variance.size() == 0) return;
  if (factors_.size() == 0) factors_ = Eigen::VectorXd::Ones(variance.size());
  variance /= factors_.array().square();  // in squared standard deviations of the measurement
  const Eigen::ArrayXd factors = (1 + variance / common_packings_).sqrt().inverse();
  const Eigen::VectorXd change = factors / factors_.array();
  factors_ = factors;
  for (std::vector<Response>* kept : {&responses_, &singles_, &coarse_singles_})
    for (Response& response : *kept) weigh(response, change);
}

void EvaluationHistory::report(const std::string& note) const {
  if (progress_) progress_({phase_, simulations(), budget_ * scoring().simulations_each(), best_error_, note});
}

void EvaluationHistory::keep_single(const Response& response, std::vector<Response>& singles) {
  const auto known = std::ranges::find_if(singles, [&](const Response& single) {
    return single.packings == response.packings && single.point == response.point;
  });
  if (known == singles.end())
    singles.push_back(response);
  else if (known->censored && !response.censored)
    *known = response;
}

Response EvaluationHistory::best_on(std::span<const std::uint64_t> packings) const {
  const auto counts = [&](const Response& one) { return is_whole(one) && std::ranges::equal(one.packings, packings); };
  return best_of(responses_, counts);
}

Response EvaluationHistory::best(std::span<const std::uint64_t> packings) const {
  Response best = best_on(packings);
  if (best.point.size() == 0) best = best_of(responses_, is_whole);
  return best.point.size() > 0 ? best : best_of(singles_, is_whole);
}

std::vector<Response> EvaluationHistory::training_data() const {
  std::vector<Response> all = corrected(coarse_singles_, singles_);
  all.insert(all.end(), singles_.begin(), singles_.end());
  return all;
}

UnitPoint EvaluationHistory::best_point(std::span<const std::uint64_t> packings) const {
  const Response best = best_on(packings);
  if (best.point.size() > 0) return best.point;
  return best_of(training_data(), [](const Response& one) { return is_feasible(one); }).point;
}

bool EvaluationHistory::any_feasible() const {
  return std::ranges::any_of(singles_, [](const Response& one) { return is_feasible(one); });
}

std::vector<Reach> reach_of(std::span<const Response> singles, std::span<const double> allowances,
                            std::span<const Response> coarse) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Reach> reach;
  for (int k = 0; k < std::ssize(allowances); ++k) {
    const double allowance = allowances[k];
    Reach one{infinity, -infinity, true, true};
    const auto heed = [&](const Response& response) {
      one.all_above = one.all_above && response.residuals[k] > allowance;
      one.all_below = one.all_below && response.residuals[k] < -allowance;
    };
    for (const Response& single : singles) {
      if (!is_feasible(single) || !has_reading(single, k)) continue;
      one.lowest = std::min(one.lowest, single.readings[k]);
      one.highest = std::max(one.highest, single.readings[k]);
      heed(single);
    }
    for (const Response& of_coarse : coarse) heed(of_coarse);
    if (one.lowest > one.highest) one = Reach{};
    reach.push_back(one);
  }
  return reach;
}

}  // namespace pastefit
