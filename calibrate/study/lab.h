#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// What of a laboratory file can be read, but looks like a slip: a number in another unit, a misread repeat. It is a
/// fault until its place stands in the file's "confirmed", and a note from then on.
class Questions {
 public:
  /// Reads "confirmed" of the file.
  explicit Questions(ObjectReader& document);

  /// `what` is said of the place; `remedy`: what to do if it is a slip.
  void ask(const std::string& place, std::string what, std::string remedy);
  /// What a person should know, but need not confirm.
  void note(const std::string& place, std::string what) { notes_.push_back(place + " " + std::move(what)); }

  /// A sentence each, without a full stop.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Faults& faults_;
  std::vector<std::string> confirmed_, notes_;
};

/// "yield_stress_pa" of the object "material", as {"value", "standard_deviation"} or {"repeats": [...]}: what a vane or
/// another rheometer read. Fault: in a test whose readings say nothing of a yield stress.
std::optional<Measurement> read_yield_stress(ObjectReader& material, const Test& test, Questions& questions);

/// What a fluid with this yield stress would read in the test, as the parts of "measurements"; empty where no formula
/// predicts anything.
std::string predicted_in_words(const Test& test, double yield_stress_pa);

/// The object "measurements": each reading with {"value", "standard_deviation"} or {"repeats": [...]}.
/// Repeats give mean and sample standard deviation; "standard_deviation" beside them is its lower bound.
/// A slump becomes the height that is left, mould height minus slump.
/// Faults: readings that contradict each other beyond their deviations (a heap that is higher after the drop), a
/// reading the apparatus cannot give, a value that the test cannot have, the same reading twice, no spread of repeats
/// and no standard deviation, no reading at all. A profile, {"points": [[x_mm, z_mm], ...], "standard_deviation"},
/// becomes the outline of `test`, and its reading is the root mean square difference from it, measured as 0.
/// Repeats that differ by more than the test's published repeatability are asked about.
/// Where there is no reading, but a yield stress, the fault says what that predicts.
std::vector<Measurement> read_measurements(ObjectReader& document, Test& test,
                                           const std::optional<Measurement>& yield_stress, Questions& questions);

/// A laboratory file's content as a `Lab`; `folder` is where the file lies, which is where its preset is looked for.
/// Errors: every fault of the content, each with its place.
Result<Lab> lab_from_json(const nlohmann::json& document, const std::filesystem::path& folder);

}  // namespace pastefit
