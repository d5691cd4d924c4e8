#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/inference/examination.h"
#include "calibrate/python/answers.h"
#include "calibrate/search/candidate_queue.h"
#include "calibrate/search/search.h"

namespace pastefit::python {

class AskedExamination;

/// A search whose simulations run in another engine. Every answer is kept before it is used, and what is known is not
/// asked again, so that a search that was ended goes on where it was.
class AskedSearch {
 public:
  explicit AskedSearch(std::unique_ptr<Answers> answers);
  ~AskedSearch();

  /// As `Search::suggest`, without those that are known.
  std::vector<Candidate> suggest(std::size_t count);
  /// Errors: every answer to what was not suggested, or without a measured reading; nothing is then taken. One could
  /// not be kept.
  Faults ingest(const std::vector<EngineAnswer>& answers);
  /// The search ends with the best so far, and nothing is examined.
  void stop();
  /// Search and examination.
  bool finished();

  /// As `result_json`, with "parameters" and "readings" of the candidate that it reports. Requirement: it has finished.
  nlohmann::ordered_json result();

  const Answers& answers() const { return *answers_; }
  Progress progress(std::string& phase) const;

 private:
  Faults faults_of(const EngineAnswer& answer, std::size_t place) const;
  /// Candidates of the search, and once it has ended those that examine which other materials fit (`examine`).
  std::vector<Candidate> next(std::size_t count);
  bool begin_examination();
  bool is_known(const Candidate& candidate);
  void tell(const Candidate& candidate, const Evaluation& evaluation);

  const std::unique_ptr<Answers> answers_;
  std::map<std::size_t, Candidate> asked_;  // of those that were suggested
  EvaluationCounts counts_;
  bool stopped_ = false;
  Calibration found_;                    // once the search has finished
  std::size_t asked_by_the_search_ = 0;  // candidates; those of the examination are numbered after them
  mutable std::mutex mutex_;             // guards what follows
  Progress progress_;
  std::string phase_;
  std::unique_ptr<Search> search_;
  std::unique_ptr<AskedExamination> examination_;
};

}  // namespace pastefit::python
