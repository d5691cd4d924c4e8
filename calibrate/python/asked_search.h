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

/// Search with an external simulator. Every answer is stored before it is used, and stored answers are not requested
/// again, so an interrupted search continues where it stopped.
class AskedSearch {
 public:
  explicit AskedSearch(std::unique_ptr<Answers> answers);
  ~AskedSearch();

  /// As `Search::suggest`, without stored candidates.
  std::vector<Candidate> suggest(std::size_t count);
  /// Takes answers. Errors: an answer to an unknown candidate, or without a measured reading (nothing is taken then);
  /// an answer cannot be stored.
  Faults ingest(const std::vector<EngineAnswer>& answers);
  /// Ends the search with the best result so far, without examination.
  void stop();
  /// True after search and examination.
  bool finished();

  /// As `result_json`, with "parameters" and "readings" of the reported candidate. Requirement: `finished()`.
  nlohmann::ordered_json result();

  const Answers& answers() const { return *answers_; }
  Progress progress(std::string& phase) const;

 private:
  Faults faults_of(const EngineAnswer& answer, std::size_t place) const;
  /// Candidates of the search; after its end, those of the examination of other fitting materials (`examine`).
  std::vector<Candidate> next(std::size_t count);
  bool begin_examination();
  bool is_known(const Candidate& candidate);
  void tell(const Candidate& candidate, const Evaluation& evaluation);

  const std::unique_ptr<Answers> answers_;
  std::map<std::size_t, Candidate> asked_;  // suggested candidates
  EvaluationCounts counts_;
  bool stopped_ = false;
  Calibration found_;                    // after the search
  std::size_t asked_by_the_search_ = 0;  // number of candidates; those of the examination are numbered after them
  mutable std::mutex mutex_;             // guards what follows
  Progress progress_;
  std::string phase_;
  std::unique_ptr<Search> search_;
  std::unique_ptr<AskedExamination> examination_;
};

}  // namespace pastefit::python
