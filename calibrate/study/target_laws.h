#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace pastefit {

/// Parameter of a starting study, in JSON.
struct StartingParameter {
  std::string_view name;
  std::string_view of_two;  ///< if a height and a spread are measured
  std::string_view of_one;  ///< if only one of them is measured; empty: omitted
  std::string_view meaning;
};

/// Laws of a starting study, with the parameters that it frees and fixes.
struct StartingLaws {
  std::string_view word;  ///< name in options: "epa"
  std::string_view normal, attraction;
  std::span<const StartingParameter> parameters;  ///< the first is the adhesion, and always free
};

/// Laws that a program implements. Its deck reproduces the heap of the card, unless `why` states a difference.
struct TargetLaws {
  std::string_view target;         ///< name in options: "edem"
  std::string_view export_target;  ///< name in `pastefit export --to`
  std::string_view law;            ///< word of the starting laws
  std::string_view rolling_model, friction_basis;
  std::string_view why;  ///< reason in one line

  const StartingLaws& laws() const;
};

/// Every target with each of its laws, its default first. The first target is the default of a study.
std::span<const TargetLaws> target_laws();

/// Laws of a target. `law`: word of the starting laws; empty: the target's default. Nothing if it has none.
std::optional<TargetLaws> laws_for(std::string_view target, std::string_view law = "");

Fault no_such_laws(std::string_view target, std::string_view law);

std::string names_of_targets();
std::string names_of_laws();

/// Commented starting study of slump tests with its laws replaced by these. Throws std::logic_error if the text has no
/// "contact" or "parameters".
std::string with_laws(std::string study, const TargetLaws& laws);

/// "contact" and "parameters" of a study; `both`: height and spread are fitted.
nlohmann::ordered_json contact_of(const TargetLaws& laws);
nlohmann::ordered_json starting_parameters(const StartingLaws& laws, bool both);

}  // namespace pastefit
