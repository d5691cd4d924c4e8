#pragma once

#include <nlohmann/json.hpp>

#include "calibrate/study/lab.h"

namespace pastefit::test {

/// A laboratory file with an apparatus of its own, as tests change it.
inline nlohmann::json lab() {
  return nlohmann::json::parse(R"({
    "format": "pastefit-lab-1", "title": "a paste",
    "provenance": {"source": "our laboratory"},
    "apparatus": {
      "mould": {"base_diameter_mm": 200, "top_diameter_mm": 130, "height_mm": 200},
      "table_length_mm": 700, "lift_velocity_mm_s": 100,
      "drop_plate": {"length_mm": 700, "mass_kg": 16, "lift_height_mm": 40},
      "reading": {"height": "highest"}},
    "material": {"bulk_density_kg_m3": 2000},
    "grains": {"distribution": "mono", "radius_mm": 8},
    "measurements": {"step1.height_mm": {"value": 70, "standard_deviation": 5}}})");
}

inline Faults faults_of(const nlohmann::json& document) {
  const Result<Lab> read = lab_from_json(document, ".");
  return read.ok() ? Faults{} : read.faults();
}

}  // namespace pastefit::test
