#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/python/stored_examination.h"
#include "calibrate/search/search.h"
#include "calibrate/search/study_scoring.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit::python {

/// What somebody else's simulator answered to a candidate.
struct EngineAnswer {
  std::size_t candidate = 0;
  Observables readings;              ///< under their names in the study; NaN: none
  std::optional<std::string> error;  ///< why there are none
};

/// The search of a study whose simulations run in another engine. Every answer is in the store before it is used, and
/// what the store knows is not asked again, so that a search that was ended goes on where it was.
class StoredSearch {
 public:
  /// `engine`: name and version of what simulates; answers of another one are no answers. `file`: of the store.
  /// Errors: what keeps the study from being searched; the store is of another engine or study.
  static Result<std::unique_ptr<StoredSearch>> open(std::shared_ptr<const Study> study, const std::string& study_file,
                                                    const std::string& file, const std::string& engine);

  /// As `Search::suggest`, without those that the store answers.
  std::vector<Candidate> suggest(std::size_t count);
  /// Errors: every answer to what was not suggested, or without a measured reading; nothing is then taken. The store
  /// could not keep one.
  Faults ingest(const std::vector<EngineAnswer>& answers);
  /// The search ends with the best so far, and nothing is examined.
  void stop();
  /// Search and examination.
  bool finished();

  /// Card and intervals. Requirement: it has finished.
  CalibrationResult result();

  const Store& store() const { return store_; }
  Progress progress(std::string& phase) const;

 private:
  StoredSearch(std::shared_ptr<const Study> study, std::string study_file, Store store);
  StoredEvaluation evaluation_of(const Candidate& candidate, const EngineAnswer& answer, std::size_t test) const;
  Faults faults_of(const EngineAnswer& answer, std::size_t place) const;
  /// Candidates of the search, and once it has ended those that examine which other materials fit (`examine`).
  std::vector<Candidate> next(std::size_t count);
  bool begin_examination();
  bool answered_by_store(const Candidate& candidate);
  void tell(const Candidate& candidate, const std::vector<StoredEvaluation>& evaluations);

  const std::shared_ptr<const Study> study_;
  const std::string study_file_;
  Store store_;
  const StudyScoring scoring_;
  std::map<std::size_t, Candidate> asked_;  // of those that were suggested
  EvaluationCounts counts_;
  bool stopped_ = false;
  Calibration found_;                    // once the search has finished
  std::size_t asked_by_the_search_ = 0;  // candidates; those of the examination are numbered after them
  mutable std::mutex mutex_;             // guards what follows
  Progress progress_;
  std::string phase_;
  // Last: their threads use all of the above.
  std::unique_ptr<Search> search_;
  std::unique_ptr<StoredExamination> examination_;
};

}  // namespace pastefit::python
