#include "calibrate/search/search.h"

#include <stdexcept>
#include <utility>

#include "calibrate/search/strategy.h"

namespace pastefit {

struct Search::Run {
  Run(const Scoring& scoring, const SearchOptions& asked, SearchStart from, std::function<void(const Progress&)> told)
      : options(asked),
        start(std::move(from)),
        progress(std::move(told)),
        queue(scoring, start.simulations),
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

const Calibration& Search::result() const {
  if (!finished()) throw std::logic_error("search: it has not finished");
  return run_->strategy.result();
}

}  // namespace pastefit
