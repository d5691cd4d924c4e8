#pragma once

#include <concepts>
#include <string_view>

#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/dimension_json.h"
#include "calibrate/laboratory/drawing.h"
#include "core/apparatus/pellet_crush/pellet_crush.h"
#include "core/apparatus/shear_cell/shear_cell.h"

namespace pastefit {

// Common parts of tests of small adhesive granules, in files and messages (core/apparatus/granules.h).

template <class T>
concept GranuleTest = std::same_as<T, PelletCrush> || std::same_as<T, ShearCell>;

template <GranuleTest T>
double grains_needed(const T& test) {
  return poured_grains(test);
}

/// Surface of the tools in laboratory and apparatus files. `meaning`: names the tools.
void read_tools(auto& apparatus, std::string_view meaning, WallContact& tools) {
  apparatus.object({"tools", meaning}, Need::optional,
                   [&](auto& fields) { read_dimensions(fields, tools, surface_dimensions, Need::optional); });
}

}  // namespace pastefit
