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

/// Pictures of a run for ParaView: grains, links and walls. A test has a series for each of its stages, with a clock
/// that starts where the first moment of it says; an impact has one.
class RunPictures {
 public:
  /// `scene` has to outlive the pictures. Nothing is written yet.
  RunPictures(const std::filesystem::path& folder, const Scene& scene);

  /// The index files of all series that a scene may have, by name.
  static std::vector<std::string> index_names(const Scene& scene);

  /// Writes the pictures of a moment. Errors: a file cannot be written.
  Faults add(const Snapshot& snapshot);

  /// The index files that were written.
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

/// What a run leaves on the disk, every two minutes and when it is asked to stop, and goes on from.
class SavedRun {
 public:
  /// `found`: what `file` held before. `stop` has to outlive the run.
  SavedRun(Checkpoint file, RunState found, const std::atomic<bool>& stop)
      : file_(std::move(file)), found_(std::move(found)), stop_(stop) {}

  bool goes_on() const { return !found_.bytes.empty(); }
  /// For `RunOptions`, once; the saved run has to stay where it is. Errors: what was found is no state.
  Result<std::shared_ptr<RunCheckpoint>> checkpoint();
  /// The outcome of the scene with that checkpoint. Errors: what was found is no state of this run, though it is what
  /// was written: it was made by hand.
  Result<Outcome> simulate(const Scene& scene, const RunOptions& run) const;

  const Faults& unwritten() const { return unwritten_; }
  /// All sessions together.
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
