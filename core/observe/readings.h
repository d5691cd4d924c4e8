#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace pastefit {

/// One reading of a test. The name contains test step and unit, e.g. "step1.height_mm"; it is the key in laboratory
/// files, results and residuals, and gives the unit of the value.
struct Reading {
  std::string name;
  double value = 0;
};

/// Readings in the order of measurement.
class Readings {
 public:
  void set(std::string_view name, double value);
  std::optional<double> find(std::string_view name) const;
  const std::vector<Reading>& all() const { return readings_; }

 private:
  std::vector<Reading> readings_;
  std::unordered_map<std::string, std::size_t> places_;  ///< index in `readings_`, by name
};

/// Mean of each reading over several runs; a reading that is missing in a run is omitted.
Readings mean_of(const std::vector<Readings>& runs);

}  // namespace pastefit
