#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "calibrate/study/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// What a reading is, which decides what values it can have.
enum class ReadingKind { height, slump, spread, shift, profile, plateau_sag, plateau_width, mass };

/// A key of "measurements" in a laboratory file.
struct ReadingKey {
  std::string_view key;         ///< as it is written, with its unit
  std::string_view observable;  ///< the reading of the simulation it is compared with; differs from `key` for a slump
  ReadingKind kind;
  bool second_step = false;  ///< needs the drop plate
  bool advised = true;       ///< as what to measure next; not if it is another form of a reading that is
};

/// Every key a laboratory file may use, in the order in which measurements are kept.
std::span<const ReadingKey> reading_keys();

/// The object "measurements": each reading with {"value", "standard_deviation"} or {"repeats": [...]}.
/// Repeats give mean and sample standard deviation; "standard_deviation" beside them is its lower bound.
/// A slump becomes the height that is left, mould height minus slump.
/// Faults: readings that contradict each other beyond their deviations (a heap that is higher after the drop), a
/// reading the apparatus cannot give, a value the test cannot have, the same reading twice, no spread of repeats and no
/// standard deviation, no reading at all.
/// A profile, {"points": [[x_mm, z_mm], ...], "standard_deviation"}, becomes the outline of `test`, and its reading is
/// the root mean square difference from it, measured as 0.
std::vector<Measurement> read_measurements(ObjectReader& document, SlumpTable& test);

}  // namespace pastefit
