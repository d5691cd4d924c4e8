#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace pastefit {

/// One reading of a test. The name carries test step and unit, e.g. "step1.height_mm";
/// it is the key in laboratory files, results and residuals alike, so the value is in the unit the name says.
struct Reading {
  std::string name;
  double value = 0;
};

/// Readings in the order in which they were taken.
class Readings {
 public:
  void set(std::string_view name, double value);
  std::optional<double> find(std::string_view name) const;
  const std::vector<Reading>& all() const { return readings_; }

 private:
  std::vector<Reading> readings_;
  std::unordered_map<std::string, std::size_t> places_;  ///< in `readings_`, by name
};

/// The mean of each reading over several runs. One that some run lacks has none.
Readings mean_of(const std::vector<Readings>& runs);

}  // namespace pastefit
