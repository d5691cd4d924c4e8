#pragma once

#include <string_view>

#include "core/laws/materials.h"

namespace pastefit {

/// A surface of a test's apparatus that grains touch. Its parameters are `<name>_friction`,
/// `<name>_rolling_friction` and `<name>_cohesion_factor`.
struct Surface {
  std::string_view name;
  WallContact& contact;
};

}  // namespace pastefit
