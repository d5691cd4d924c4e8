#include <algorithm>
#include <array>

#include "calibrate/base/text.h"
#include "calibrate/judge/verdict.h"
#include "calibrate/search/search.h"

namespace pastefit {

std::string_view name_of(CalibrationStatus status) {
  constexpr std::array<std::string_view, 5> names{"confirmed", "unconfirmed", "out_of_reach", "stopped", "failed"};
  static_assert(static_cast<std::size_t>(CalibrationStatus::failed) + 1 == names.size());
  return names[static_cast<std::size_t>(status)];
}

namespace {

std::string tolerance_in_words(const ErrorUnit& unit) {
  return unit.tolerance_mm ? "the tolerance of " + unit.words(1) : "the tolerances of the readings";
}

/// Why the best candidate is not confirmed.
std::string doubt_about(const Calibration& result, const ErrorUnit& unit, double rejected_share,
                        const std::string& spent) {
  const Response& told = result.confirmation.point.size() > 0 ? result.confirmation : result.best;
  const Evidence evidence = evidence_of(told);
  const Verdict verdict = verdict_on(evidence, rejected_share);
  if (verdict != verdict_on_readings(evidence)) {
    const std::string heaps =
        format("Of the best candidate's %zu heaps %d sheared off", told.evaluations.size(), told.rejected);
    if (verdict == Verdict::refuted && told.rejected > 0)
      return heaps + format(": more than a share of %g", rejected_share) + spent;
    if (verdict == Verdict::refuted) return heaps + ", but all came close to it" + spent;
    return heaps + format(": it is not yet known whether the share is at most %g", rejected_share) + spent +
           " Allow more simulations.";
  }
  const std::string tolerance = tolerance_in_words(unit);
  std::string words = "The best candidate differs from the measurement by " + unit.words(told.error);
  if (told.error > 1) return words + ", more than " + tolerance + spent;
  if (result.confirmation.point.size() == 0) return words + ", but not on fresh packings" + spent;
  return words + " +- " + unit.words(told.noise) + ": its packings scatter too much for a decision on " + tolerance +
         spent + " Allow more simulations.";
}

}  // namespace

void Search::explain(const std::optional<OutOfReach>& out_of_reach) {
  Calibration& result = result_;
  const ErrorUnit unit = state_.scoring().error_unit();
  const std::string coarse =
      with_coarse_ ? " and " + std::to_string(result.coarse_simulations) + " with coarse grains" : "";
  const std::string spent = " (" + std::to_string(result.simulations) + " simulations" + coarse + ").";
  if (confirmation_.confirmed()) {
    result.status = CalibrationStatus::confirmed;
    result.reason = "The candidate differs from the measurement by " + unit.words(result.confirmation.error) + " on " +
                    std::to_string(result.confirmation.packings.size()) + " fresh packings, within " +
                    tolerance_in_words(unit) + spent;
  } else if (state_.history.stop_requested()) {
    result.status = CalibrationStatus::stopped;
    result.reason = (result.best.point.size() > 0
                         ? "The search was stopped; this is the best material so far"
                         : "The search was stopped before a simulation had all its readings; --resume continues") +
                    spent;
  } else if (out_of_reach && !searched_) {
    result.status = CalibrationStatus::out_of_reach;
    result.reason = describe(*out_of_reach, start_.readings, start_.parameters) +
                    " The search was not started; this is the nearest material" + spent;
  } else if (!state_.history.any_feasible()) {
    result.status = CalibrationStatus::failed;
    result.reason =
        "Every simulation failed" + spent + " Look at the reasons, and move the bounds away from that region.";
  } else if (result.best.point.size() == 0) {
    result.reason = "No simulation of a candidate is complete" + spent + " Allow more simulations.";
  } else {
    result.status = CalibrationStatus::unconfirmed;
    result.reason = doubt_about(result, unit, state_.scoring().rejected_share(), spent);
    for (std::size_t k = 0; k < result.reach.size(); ++k) {
      const Reach& reach = result.reach[k];
      const std::string name = k < start_.readings.size() ? start_.readings[k] : "reading " + std::to_string(k + 1);
      result.reason +=
          " Simulated values of " + name + ": " + format("%.3g", reach.lowest) + " to " + format("%.3g", reach.highest);
      if (reach.all_above || reach.all_below) {
        const bool certain = out_of_reach && out_of_reach->reading == k;
        if (certain) result.status = CalibrationStatus::out_of_reach;
        result.reason +=
            std::string(", all ") + (reach.all_above ? "above" : "below") + " the measured one" +
            (certain ? ": the model cannot reach it within these bounds" : ", which may still be in reach");
      }
      result.reason += ".";
    }
    if (result.status == CalibrationStatus::out_of_reach && out_of_reach)
      result.reason += " " + describe(*out_of_reach, start_.readings, start_.parameters);
    if (std::ranges::any_of(state_.history.singles(), &Response::censored))
      result.reason += " Runs that were stopped early enter as bounds.";
  }
}

}  // namespace pastefit
