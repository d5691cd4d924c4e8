#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Values in a laboratory file that are readable but suspicious, e.g. a number in another unit or a misread repeat.
/// Each is a fault, or only a note if its place is listed in "confirmed" of the file.
class Questions {
 public:
  /// Reads "confirmed".
  explicit Questions(ObjectReader& document);

  /// Reports a suspicious value. `what`: end of a sentence about the place. `remedy`: what to do if it is a slip.
  void ask(const std::string& place, std::string what, std::string remedy);
  void note(const std::string& place, std::string what) { notes_.push_back(place + " " + std::move(what)); }

  /// One sentence per note, without a full stop.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Faults& faults_;
  std::vector<std::string> confirmed_, notes_;
};

/// Reads "yield_stress_pa" of "material", {"value", "standard_deviation"} or {"repeats": [...]}: from a vane or another
/// rheometer. Fault: no reading of this test is related to a yield stress.
std::optional<Measurement> read_yield_stress(ObjectReader& material, const Test& test, Questions& questions);

/// Reads "measurements": each reading with {"value", "standard_deviation"} or {"repeats": [...]}.
/// Repeats give mean and sample standard deviation; "standard_deviation" beside them is its lower bound. A slump
/// becomes the height of the heap, mould height minus slump. A profile, {"points": [[x_mm, z_mm], ...],
/// "standard_deviation"}, becomes the outline of `test`; its reading is the root mean square difference from it, with
/// the measured value 0. Repeats that differ by more than the published repeatability of the test are asked about.
/// Faults: readings that contradict each other beyond their deviations (a heap that is higher after the drop), a
/// reading that the apparatus does not have, an impossible value, a duplicate reading, neither spread of repeats nor
/// standard deviation, no reading at all; if there is a yield stress instead, the fault states the readings it
/// predicts.
std::vector<Measurement> read_measurements(ObjectReader& document, Test& test,
                                           const std::optional<Measurement>& yield_stress, Questions& questions);

/// Parses the content of a laboratory file. `folder`: where the file is, and where its preset is looked for. Errors:
/// every fault, with its place.
Result<Lab> lab_from_json(const nlohmann::json& document, const std::filesystem::path& folder);

}  // namespace pastefit
