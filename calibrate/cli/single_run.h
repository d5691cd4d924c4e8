#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibrate/card/scene.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/report/vtk.h"
#include "calibrate/store/checkpoint.h"
#include "core/step/run.h"
#include "core/step/run_checkpoint.h"

namespace pastefit {

/// ParaView pictures of a run: grains, links and walls. A test has one series per stage, whose clock starts at the time
/// of its first snapshot; an impact has one series.
class RunPictures {
 public:
  /// `scene` must outlive the pictures. Writes nothing yet.
  RunPictures(const std::filesystem::path& folder, const Scene& scene);

  /// Names of the index files of all possible series.
  static std::vector<std::string> index_names(const Scene& scene);

  /// Writes the pictures of a snapshot. Errors: a file cannot be written.
  Faults add(const Snapshot& snapshot);

  /// Index files that were written.
  std::vector<std::filesystem::path> indices() const;

 private:
  struct Stage {
    std::vector<VtkSeries> layers;
    double last_s = 0, earlier_s = 0;
    bool begun = false;
  };

  const Scene& scene_;
  std::vector<Stage> stages_;
};

/// State of a run on disk, for continuation; saved every two minutes and on `stop`.
class SavedRun {
 public:
  /// `found`: previous content of `file`. `stop` must outlive the run.
  SavedRun(Checkpoint file, RunState found, const std::atomic<bool>& stop)
      : file_(std::move(file)), found_(std::move(found)), stop_(stop) {}

  bool goes_on() const { return !found_.bytes.empty(); }
  /// Checkpoint for `RunOptions`; call once, and do not move this object afterwards. Errors: invalid state.
  Result<std::shared_ptr<RunCheckpoint>> checkpoint();
  /// Simulates the scene with that checkpoint. Errors: a valid checksum, but no state of this run: the file was made by
  /// hand.
  Result<Outcome> simulate(const Scene& scene, const RunOptions& run) const;

  const Faults& unwritten() const { return unwritten_; }
  /// Sum over all sessions.
  double wall_s() const { return found_.wall_s + std::chrono::duration<double>(Clock::now() - start_).count(); }
  void remove() const { file_.remove(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes kBetween{2};

  void keep(const std::string& state);

  Checkpoint file_;
  RunState found_;
  const std::atomic<bool>& stop_;
  Clock::time_point start_ = Clock::now(), next_ = start_ + kBetween;
  Faults unwritten_;
};

}  // namespace pastefit
