#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "core/apparatus/specimen.h"
#include "core/result.h"

namespace pastefit {

/// Collects faults of numbers that are not finite or out of range.
class FieldChecker {
 public:
  /// Adds no second fault for the same place.
  void range(std::string where, double value, double lower, double upper, std::string_view unit) {
    if (std::isfinite(value) && value >= lower && value <= upper) return;
    const auto at_place = [&](const Fault& fault) { return fault.where == where; };
    if (std::ranges::any_of(faults_, at_place)) return;
    faults_.push_back(fault_of(std::move(where), {value, lower, upper, std::string(unit)}));
  }
  void require(bool holds, std::string where, std::string what, std::string remedy) {
    if (!holds) faults_.push_back({std::move(where), std::move(what), std::move(remedy)});
  }
  static Fault fault_of(std::string where, OutOfRange range) {
    const std::string unit = range.unit.empty() ? "" : " " + range.unit;
    return {std::move(where), "is " + text(range.value) + unit,
            "give a number from " + text(range.smallest) + " to " + text(range.largest) + unit, std::move(range)};
  }

  Faults take() { return std::move(faults_); }

  static std::string text(double value) {
    std::string s(32, '\0');
    s.resize(std::snprintf(s.data(), s.size(), "%.6g", value));
    return s;
  }
  /// A length in mm, the unit of files and messages.
  static std::string in_mm(double length_m) { return text(1e3 * length_m) + " mm"; }

 private:
  Faults faults_;
};

/// Checks what all tests share: grains, density, contact laws. Places are field paths.
void check_specimen(FieldChecker& check, const Specimen& specimen);

/// Checks a surface of the apparatus.
void check_wall(FieldChecker& check, const WallContact& wall, const std::string& name);

}  // namespace pastefit
