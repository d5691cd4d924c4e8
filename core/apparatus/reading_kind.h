#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace pastefit {

/// Values a reading can have, in its unit, bounds included.
struct ReadingRange {
  double smallest = std::numeric_limits<double>::lowest();
  double largest = std::numeric_limits<double>::max();
};

/// A reading that another one of the same test is not above.
struct Ceiling {
  std::string_view name;  ///< of the larger one; empty: none
  std::string_view why;   ///< for a person
};

/// Why a test does not have a reading, for a person.
struct Lack {
  std::string_view what, remedy;
};

/// All that is said of one reading of a test, once: by the laboratory that takes it, the simulation that gives it, and
/// the search that compares both. The table of a test stands beside its apparatus, because a reading is added by what
/// reads the specimen; of files it knows the words only.
struct ReadingKind {
  std::string_view name;     ///< of the simulation's reading, with its stage and unit, e.g. "step1.height_mm"
  std::string_view key;      ///< in laboratory files; empty: laboratories do not take it
  std::string_view measure;  ///< reading that the laboratory's is compared with; another one for a slump, else `name`
  int stage = 0;             ///< of the test in which it is taken, counted from 0
  ReadingRange possible;     ///< what a laboratory can read, with room for its apparatus
  std::string_view bounded_by{};  ///< what its largest value is, where that follows from a place in files; else empty
  std::optional<double> worst_miss{};       ///< the farthest a simulation can be off, if there is such a bound
  std::optional<double> less_than{};        ///< where `measure` is another reading: it is this less the laboratory's
  std::array<Ceiling, 2> ceilings{};        ///< what it is not above
  std::optional<Lack> lack = std::nullopt;  ///< the test does not have it
  bool advised = false;                     ///< as what to measure next; not if it is another form of one
  bool checked = false;                     ///< by `check`; not if it is another form of one, or a count
  bool ends_early = false;                  ///< a candidate far off here is not simulated to its end
  bool from_outline = false;                ///< only where the laboratory gives an outline
  bool on_request = false;                  ///< only where the apparatus asks for it, or the laboratory took it
  /// Place in files of the condition that it depends on so much that a laboratory has to state it; empty: on none.
  std::string_view depends_on{};
  std::string_view repeatability{};  ///< published of the deviation; empty: nothing is
  double published_deviation = 0;    ///< that deviation for this apparatus, in the reading's unit; 0: none is
};

/// The row with this name of the simulation's reading; nothing if there is none.
inline const ReadingKind* find_kind(std::span<const ReadingKind> kinds, std::string_view name) {
  const auto found = std::ranges::find(kinds, name, &ReadingKind::name);
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace pastefit
