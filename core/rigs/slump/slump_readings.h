#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "core/rigs/slump/slump_test.h"

namespace pastefit {

/// When in the test a reading is taken; in this order.
enum class Stage { fill, step1, step2 };

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

/// All that is said of one reading of the slump test, once: by the laboratory that takes it, the simulation that gives
/// it, and the search that compares both. It stands beside the rig, because a reading is added by what reads the heap;
/// of files it knows the words only.
struct ReadingKind {
  std::string_view name;     ///< of the simulation's reading, with its stage and unit, e.g. "step1.height_mm"
  std::string_view key;      ///< in laboratory files; empty: laboratories do not take it
  std::string_view measure;  ///< reading that the laboratory's is compared with; another one for a slump, else `name`
  Stage stage = Stage::step1;
  ReadingRange (*possible)(const SlumpTable&);  ///< what a laboratory can read, with room for its apparatus
  double (*worst_miss)(const SlumpTable&);      ///< the farthest a heap can be off; none: it has no such bound
  std::array<Ceiling, 2> ceilings{};            ///< what it is not above
  bool advised = false;                         ///< as what to measure next; not if it is another form of one
  bool checked = false;                         ///< by `check`; not if it is another form of one, or a count
  bool ends_early = false;                      ///< a candidate far off here is not simulated to its end
  bool with_outline = false;                    ///< only where the laboratory gives an outline
  std::string_view repeatability{};             ///< published of the deviation; empty: nothing is
};

/// Every reading, in the order in which a simulation gives them.
std::span<const ReadingKind> reading_kinds();

/// The row with this name of the simulation's reading; nothing if there is none.
const ReadingKind* reading_kind(std::string_view name);

/// The stage of a reading, known or not, by its name. Requirement: the name begins with one of the stages.
Stage stage_of(std::string_view name);

}  // namespace pastefit
