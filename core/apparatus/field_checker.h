#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/apparatus/specimen.h"
#include "core/result.h"

namespace pastefit {

/// Collects faults of numbers that are not finite or not in their range.
class FieldChecker {
 public:
  void range(const char* where, double value, double lower, double upper, const char* unit) {
    if (std::isfinite(value) && value >= lower && value <= upper) return;
    faults_.push_back(fault_of(where, {value, lower, upper, unit}));
  }
  void require(bool holds, const char* where, std::string what, std::string remedy) {
    if (!holds) faults_.push_back({where, std::move(what), std::move(remedy)});
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
  /// A length as files and people have it.
  static std::string in_mm(double length_m) { return text(1e3 * length_m) + " mm"; }

 private:
  Faults faults_;
};

/// Faults of what all tests share: grains, density, contact laws. Places are the fields' paths in a test.
void check_specimen(FieldChecker& check, const Specimen& specimen);

/// Faults of a surface of the apparatus.
void check_wall(FieldChecker& check, const WallContact& wall, const std::string& name);

}  // namespace pastefit
