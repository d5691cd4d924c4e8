#include "calibrate/search/search.h"

#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

#include "calibrate/search/strategy.h"

namespace pastefit {

struct Search::Run {
  Run(const Scoring& scoring, const SearchOptions& asked, SearchStart from, std::function<void(const Progress&)> told)
      : options(asked),
        start(std::move(from)),
        progress(std::move(told)),
        queue(scoring, start.simulations, start.answers),
        strategy(queue, options, start, progress) {}

  const SearchOptions options;
  const SearchStart start;
  const std::function<void(const Progress&)> progress;
  CandidateQueue queue;
  Strategy strategy;
};

Search::Search(const Scoring& scoring, const SearchOptions& options, SearchStart start,
               std::function<void(const Progress&)> progress) {
  if (!validate(options, scoring.parameters(), scoring.simulations_each()).empty())
    throw std::logic_error("search: options that are not valid");
  run_ = std::make_unique<Run>(scoring, options, std::move(start), std::move(progress));
}

Search::~Search() = default;

std::vector<Candidate> Search::suggest(std::size_t count) {
  run_->strategy.advance();
  return run_->queue.suggest(count);
}

void Search::ingest(std::span<const CandidateResult> results) {
  run_->queue.ingest(results);
  run_->strategy.advance();
}

void Search::stop() {
  run_->queue.stop();
  run_->strategy.advance();
}

bool Search::finished() const {
  return run_->strategy.finished();
}

std::vector<CandidateResult> Search::results() const {
  return run_->queue.results();
}

const Calibration& Search::result() const {
  if (!finished()) throw std::logic_error("search: it has not finished");
  return run_->strategy.result();
}

Calibration drive(Search& search, Objective& objective, Objective* coarse) {
  const auto of = [&](const Candidate& one) -> Objective& {
    return one.fidelity == Fidelity::fine ? objective : *coarse;
  };
  std::deque<Candidate> under_way;
  while (!search.finished()) {
    if (objective.stop_requested()) search.stop();
    const auto candidates = search.suggest(std::numeric_limits<std::size_t>::max());
    for (const Candidate& one : candidates) {
      of(one).begin({&one.point, 1}, {&one.packing, 1}, one.may_end_early);
      under_way.push_back(one);
    }
    if (!candidates.empty() || under_way.empty()) continue;
    const Candidate first = std::move(under_way.front());
    under_way.pop_front();
    const auto answer = first.may_end_early ? &Objective::try_out : &Objective::evaluate;
    const Response response = (of(first).*answer)({&first.point, 1}, {&first.packing, 1}).at(0);
    const CandidateResult result{first.number, response.evaluations.at(0)};
    search.ingest({&result, 1});
  }
  return search.result();
}

Calibration search(Objective& objective, const SearchOptions& options,
                   const std::function<void(const Progress&)>& progress, std::span<const std::string> readings,
                   std::span<const std::string> parameters, Objective* coarse) {
  Search search(objective, options,
                {.simulations = objective.simulations_left(),
                 .with_coarse = coarse != nullptr,
                 .earlier = objective.earlier(),
                 .readings = {readings.begin(), readings.end()},
                 .parameters = {parameters.begin(), parameters.end()}},
                progress);
  return drive(search, objective, coarse);
}

}  // namespace pastefit
