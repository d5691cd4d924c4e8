#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pastefit {

/// The laws that a program runs exactly, as a study chooses them, so that the heap of its deck is the card's.
struct TargetLaws {
  std::string_view target;         ///< as people call it: "edem"
  std::string_view export_target;  ///< of `pastefit export --to`
  std::string_view normal, attraction, rolling_model, friction_basis;
  std::string_view strength;  ///< the parameter that makes the grains stick, with its bounds
  double weakest = 0, strongest = 0;
  std::string_view why;  ///< for a person, one line
};

/// Every target that has such laws; the first is what a study chooses that names no target.
std::span<const TargetLaws> target_laws();

/// The laws of the target with this name. Nothing if there are none.
std::optional<TargetLaws> laws_for(std::string_view target);

/// "lammps, liggghts, ...".
std::string names_of_targets();

/// The commented starting file of a study of slump tests, with these laws in place of its own.
std::string with_laws(const std::string& study, const TargetLaws& laws);

/// "contact" of a study.
nlohmann::ordered_json contact_of(const TargetLaws& laws);

}  // namespace pastefit
