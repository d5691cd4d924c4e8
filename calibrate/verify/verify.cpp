#include "calibrate/verify/verify.h"

#include <algorithm>
#include <cmath>

#include "core/step/run.h"

namespace pastefit {

namespace {

constexpr double kPublishedDigits = 1e-3;  // figures are printed with four digits or more; constants in them differ

std::string_view word_for(Transform transform) {
  switch (transform) {
    case Transform::shift:
      return "ends alike when shifted";
    case Transform::turn:
      return "ends alike when turned";
    case Transform::mirror:
      return "ends alike in the mirror";
    case Transform::boost:
      return "ends alike when boosted";
    case Transform::lengthen:
      return "ends alike when 3 x as large";
  }
  return "";
}

Result<double> expected_value(const Check& check, const Impact& scene, const Point& point) {
  if (const auto* value = std::get_if<double>(&check.expected)) return *value;
  if (const auto* most = std::get_if<AtMost>(&check.expected)) return most->bound;
  const auto& by = std::get<ByFormula>(check.expected);
  auto value = value_of(*by.formula, scene, by.arguments);
  if (!value) {
    Faults faults = value.faults();
    for (Fault& fault : faults) fault.where = check.reading + " at \"" + point.label + "\": " + fault.where;
    return faults;
  }
  const auto printed = point.published.find(check.reading);
  if (printed == point.published.end()) return value;
  if (std::fabs(value.value() / printed->second - 1) < kPublishedDigits) return value;
  return Fault{check.reading + " at \"" + point.label + "\"",
               "the formula gives " + std::to_string(value.value()) + ", not what is published",
               "correct the scene or the published figure"};
}

/// Fills in error and verdict.
void judge(const Check& check, CheckRow& row) {
  row.tolerance = check.tolerance;
  row.absolute = check.absolute;
  row.bound = std::holds_alternative<AtMost>(check.expected);
  row.error = row.bound ? std::max(row.got - row.expected, 0.0) : std::fabs(row.got - row.expected);
  if (!row.absolute && !row.bound) row.error /= std::fabs(row.expected);
  // Written so that an error that is no number does not pass.
  const bool good = row.error <= row.tolerance;
  row.verdict = good ? CaseVerdict::pass : check.known_deviation.empty() ? CaseVerdict::fail : CaseVerdict::known;
  if (!good) row.note = check.known_deviation;
}

CheckRow without_answer(CheckRow row, const Check& check, std::string why) {
  row.got = row.error = std::nan("");
  row.tolerance = check.tolerance;
  row.note = std::move(why);
  return row;
}

CheckRow compare_views(const Check& check, const Impact& scene, const Outcome& outcome, CheckRow row) {
  const Transform transform = *check.unchanged_under;
  const Outcome seen = simulate(transformed(scene, transform));
  row.reading = word_for(transform);
  if (seen.failure) return without_answer(std::move(row), check, seen.failure->message);
  row.got = difference(scene, outcome, transform, seen);
  judge(check, row);
  return row;
}

Result<CheckRow> compared(const Check& check, const Point& point, const Impact& scene, const Outcome& outcome) {
  CheckRow row;
  row.point = point.label;
  row.reading = check.reading;
  const auto expected = expected_value(check, scene, point);
  if (!expected) return expected.faults();
  row.expected = expected.value();
  if (outcome.failure)
    return without_answer(std::move(row), check,
                          std::string(name_of(outcome.failure->reason)) + ": " + outcome.failure->message);
  if (check.unchanged_under) return compare_views(check, scene, outcome, std::move(row));
  const auto got = outcome.observables.find(check.reading);
  if (!got) return without_answer(std::move(row), check, "the test has no such reading");
  row.got = *got;
  judge(check, row);
  return row;
}

}  // namespace

std::string_view name_of(CaseVerdict verdict) {
  return verdict == CaseVerdict::pass ? "pass" : verdict == CaseVerdict::known ? "known" : "FAIL";
}

Result<std::vector<CheckRow>> verify(const Case& test, const std::function<void()>& point_done) {
  std::vector<CheckRow> rows;
  Faults faults;
  for (const Point& point : test.points) {
    const auto scene = scene_at(test, point);
    if (!scene) {
      faults.insert(faults.end(), scene.faults().begin(), scene.faults().end());
      continue;
    }
    const Outcome outcome = simulate(scene.value());
    for (std::size_t c = 0; c < test.checks.size(); ++c) {
      auto row = compared(test.checks[c], point, scene.value(), outcome);
      if (row) {
        rows.push_back(std::move(row).value());
        rows.back().check = c;
      } else {
        faults.insert(faults.end(), row.faults().begin(), row.faults().end());
      }
    }
    if (point_done) point_done();
  }
  if (!faults.empty()) return faults;
  return rows;
}

std::vector<CheckRow> worst_rows(const std::vector<CheckRow>& rows) {
  const auto burden = [](const CheckRow& row) {
    if (std::isnan(row.error)) return 1e300;
    return row.tolerance > 0 ? row.error / row.tolerance : row.error * 1e100;
  };
  std::vector<CheckRow> worst;
  for (const CheckRow& row : rows) {
    const auto same = std::ranges::find(worst, row.check, &CheckRow::check);
    if (same == worst.end())
      worst.push_back(row);
    else if (burden(row) > burden(*same))
      *same = row;
  }
  return worst;
}

}  // namespace pastefit
