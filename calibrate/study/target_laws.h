#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace pastefit {

/// A parameter of a starting study, in JSON.
struct StartingParameter {
  std::string_view name;
  std::string_view of_two;  ///< where a height and a spread are measured; empty: left out
  std::string_view of_one;  ///< where one of them is
  std::string_view meaning;
};

/// Laws that a study may start from, with the parameters that it frees and fixes.
struct StartingLaws {
  std::string_view word;  ///< as people choose it: "epa"
  std::string_view normal, attraction;
  std::span<const StartingParameter> parameters;  ///< the first makes the grains stick, and is always free
  std::string_view meaning;
};

/// Laws that a program runs: exactly, so that the heap of its deck is the card's, unless `why` says what differs.
struct TargetLaws {
  std::string_view target;         ///< as people call it: "edem"
  std::string_view export_target;  ///< of `pastefit export --to`
  std::string_view law;            ///< word of the starting laws
  std::string_view rolling_model, friction_basis;
  std::string_view why;  ///< for a person, one line

  const StartingLaws& laws() const;
};

/// Every target with each of its laws, the one that it starts from first; the first target is what a study chooses that
/// names none.
std::span<const TargetLaws> target_laws();

/// The laws of the target with this name; `law`: the word of the starting laws, empty: those it starts from. Nothing if
/// it has none.
std::optional<TargetLaws> laws_for(std::string_view target, std::string_view law = "");

/// What to say where there are none.
Fault no_such_laws(std::string_view target, std::string_view law);

std::string names_of_targets();
std::string names_of_laws();

/// The commented starting file of a study of slump tests, with these laws in place of its own. Throws std::logic_error
/// if the file has no "contact" or "parameters" to put them in.
std::string with_laws(const std::string& study, const TargetLaws& laws);

/// "contact" and "parameters" of a study; `both`: a height and a spread are fitted.
nlohmann::ordered_json contact_of(const TargetLaws& laws);
nlohmann::ordered_json starting_parameters(const StartingLaws& laws, bool both);

}  // namespace pastefit
