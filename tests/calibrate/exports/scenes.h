#pragma once

#include <string>
#include <variant>

#include "calibrate/exports/export.h"
#include "calibrate/study/parameters.h"

// What the tests of exports export.
namespace pastefit::export_scenes {

inline constexpr double kRadius = 0.008;
inline constexpr GrainPair kPair{kRadius, kRadius, kRadius};

inline SlumpTest slump_of_paste() {
  SlumpTest out;
  out.grains.radius_m = kRadius;
  return std::get<SlumpTest>(with_contact_of(with_default_contact(out), default_values()));
}

/// A mould with three grains in it: exporters do not care how it was filled.
inline ExportScene scene(const SlumpTest& test) {
  ExportScene out;
  out.title = "Paste";
  out.test = test;
  out.packing.centres = {{0, 0, kRadius}, {0.05, 0, kRadius}, {0, 0.05, 0.1}};
  out.packing.radii.assign(3, kRadius);
  out.grain_density_kg_m3 = 3800;
  out.sizes = size_classes(out.packing.radii);
  return out;
}

inline std::string text_of(const Export& written) {
  std::string text;
  for (const auto& file : written.files) text += file.content;
  for (const auto& note : written.notes) text += note + "\n";
  return text;
}

}  // namespace pastefit::export_scenes
