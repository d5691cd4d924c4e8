#include "calibrate/cli/single_run.h"

#include <array>
#include <string_view>

#include "core/world/world.h"

namespace pastefit {

namespace {

/// Layers of a picture, one series each: suffixes of the name of the grains' series.
constexpr std::array<std::string_view, 3> kLayers{"", "-links", "-walls"};

/// One series each, for a clock of its own. A run has those of the stages that it comes to.
constexpr std::array<std::string_view, 3> kStages{"filling", "grains", "grains-second-drop"};

std::size_t stage_of(const Snapshot& snapshot) {
  return snapshot.phase.starts_with("fill.") ? 0 : static_cast<std::size_t>(snapshot.drop) + 1;
}

}  // namespace

RunPictures::RunPictures(const std::filesystem::path& folder) {
  for (const std::string_view name : kStages) {
    Stage& stage = stages_.emplace_back();
    for (const std::string_view layer : kLayers)
      stage.layers.emplace_back(folder, std::string(name) + std::string(layer));
  }
}

std::vector<std::string> RunPictures::index_names() {
  std::vector<std::string> names;
  for (const std::string_view name : kStages)
    for (const std::string_view layer : kLayers) names.push_back(std::string(name) + std::string(layer) + ".pvd");
  return names;
}

Faults RunPictures::add(const Snapshot& snapshot) {
  Stage& stage = stages_.at(stage_of(snapshot));
  // A stage may consist of several consecutive runs.
  if (snapshot.time_s < stage.last_s) stage.earlier_s += stage.last_s;
  stage.last_s = snapshot.time_s;
  stage.begun = true;
  const World& world = *snapshot.world;
  const std::array<VtkFrame, kLayers.size()> frames{grain_frame(world), link_frame(world), wall_frame(world)};
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (auto faults = stage.layers[i].add(snapshot.time_s + stage.earlier_s, frames[i]); !faults.empty()) return faults;
  return {};
}

std::vector<std::filesystem::path> RunPictures::indices() const {
  std::vector<std::filesystem::path> files;
  for (const Stage& stage : stages_)
    for (const VtkSeries& layer : stage.layers)
      if (stage.begun) files.push_back(layer.index());
  return files;
}

}  // namespace pastefit
