#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace pastefit {

/// Possible values of a reading, in its unit, bounds included.
struct ReadingRange {
  double smallest = std::numeric_limits<double>::lowest();
  double largest = std::numeric_limits<double>::max();
};

/// A larger reading of the same test that limits this one.
struct Ceiling {
  std::string_view name;  ///< of the larger reading; empty: none
  std::string_view why;   ///< reason in messages
};

/// Why a test does not have a reading, and what to do.
struct Lack {
  std::string_view what, remedy;
};

/// Everything about one reading, in one row: its key in the laboratory file, its name in the simulation, and how the
/// search compares them. The table of a test is beside its apparatus, because a new reading needs new code there.
struct ReadingKind {
  std::string_view name;          ///< of the simulated reading, with stage and unit, e.g. "step1.height_mm"
  std::string_view key;           ///< in laboratory files; empty: not measured
  std::string_view measure;       ///< simulated reading to compare with; differs from `name` for a slump
  int stage = 0;                  ///< of the test, counted from 0
  ReadingRange possible;          ///< plausible measured values, with a margin for the apparatus
  std::string_view bounded_by{};  ///< in messages: the dimension in files that limits its largest value; else empty
  std::optional<double> worst_miss{};  ///< largest possible deviation of a simulation, if bounded
  std::optional<double> less_than{};   ///< if `measure` is another reading: it equals this minus the measured value
  std::array<Ceiling, 2> ceilings{};   ///< readings that are never smaller
  std::optional<Lack> lack = std::nullopt;  ///< set if the test does not have the reading
  bool advised = false;                     ///< suggested as a further measurement; not for a second form of a reading
  bool checked = false;                     ///< compared by `check`; not for a second form of a reading, or a count
  bool ends_early = false;                  ///< a simulation far off here is stopped early
  bool from_outline = false;                ///< only if the laboratory gives an outline
  bool on_request = false;                  ///< only if the apparatus requests it or the laboratory measured it
  /// Place in files of a condition that strongly affects it, so that laboratories must state it; empty: none.
  std::string_view depends_on{};
  std::string_view repeatability{};  ///< source of a published deviation; empty: none
  double published_deviation = 0;    ///< that deviation for this apparatus, in the reading's unit; 0: none
};

/// The row with this name of a simulated reading; nullptr if there is none.
inline const ReadingKind* find_kind(std::span<const ReadingKind> kinds, std::string_view name) {
  const auto found = std::ranges::find(kinds, name, &ReadingKind::name);
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace pastefit
