#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/card/scene.h"
#include "calibrate/report/vtk.h"
#include "core/step/run.h"

namespace pastefit {

/// ParaView pictures of a run: grains, links and walls. A test has one series per stage, whose clock starts at the time
/// of its first snapshot; an impact has one stage.
class RunPictures {
 public:
  /// Writes nothing yet.
  explicit RunPictures(const std::filesystem::path& folder);

  /// Names of the index files of all possible series.
  static std::vector<std::string> index_names();

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

  std::vector<Stage> stages_;
};

}  // namespace pastefit
