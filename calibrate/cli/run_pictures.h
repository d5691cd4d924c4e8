#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/card/scene.h"
#include "calibrate/report/vtk.h"
#include "core/step/run.h"

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

}  // namespace pastefit
