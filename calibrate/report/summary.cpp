#include "calibrate/report/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/report/type_in_table.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

std::string parameter_lines(const Card& card) {
  std::string out = "Scale-free parameters, the same for every grain size\n";
  for (const auto& parameter : card.material.parameters) {
    if (!has_parameter(card, parameter.name)) continue;
    out += format("  %-24s %14.6g", parameter.name.c_str(), parameter.value);
    out += parameter.free ? format("   fitted, %g to %g", parameter.lower, parameter.upper) : "   fixed";
    if (const auto& prior = parameter.prior)
      out += format(", known as %g +- %g", prior->value, prior->standard_deviation);
    out += "\n";
  }
  return out;
}

std::string reading_lines(const std::vector<CardReading>& readings) {
  std::string out;
  for (const auto& reading : readings) {
    const auto error = standard_error(reading);
    out += format("  %-24s ", reading.name.c_str());
    out += reading.measured ? format("%10.4g %10.3g ", *reading.measured, reading.standard_deviation)
                            : format("%10s %10s ", "-", "-");
    out += format("%10.5g ", reading.simulated) + (error ? format("+- %-6.2g", *error) : std::string(9, ' '));
    if (reading.measured)
      out += format(" %+9.3g%s", reading.simulated - *reading.measured, reading.weight > 0 ? "" : "   (not fitted)");
    if (reading.band) out += format("\n    (noise explains +-%.3g)", *reading.band);
    out += "\n";
  }
  return out;
}

std::string reading_lines(const Card& card) {
  const auto packings = card.confirmation.packings.size();
  std::string out =
      format("%-26s %10s %10s %-20s%10s\n", "Reading", "measured", "+- sd", "simulated +- error", "difference");
  for (const auto& test : card.tests) {
    if (!test.name.empty())
      out += "Test " + test.name + (test.hold_out ? ", validation test: predicted, not fitted\n" : "\n");
    out += test.readings.empty() ? "  not simulated\n" : reading_lines(test.readings);
  }
  if (packings == 1) out += "  Simulated: one packing, error unknown.\n";
  return out;
}

/// Yield stresses from simulated readings, compared with the measured one.
std::string measured_yield_stress_lines(const CardTest& test, const std::vector<ComparedYieldStress>& compared) {
  if (!test.yield_stress) return "";
  std::string out = format("  %-24s %10.4g %10.3g %10s Pa  measured\n", reading_name(test, "yield_stress_pa").c_str(),
                           test.yield_stress->value, test.yield_stress->standard_deviation, "-");
  for (const ComparedYieldStress& one : compared)
    out += format("    by %s: %.2g times the measured one, %+.2g standard deviations\n", one.reading.c_str(),
                  *one.ratio, *one.deviations);
  return out;
}

/// Yield stresses from measured and simulated readings.
std::string yield_stress_lines(const Card& card) {
  std::string out;
  for (const CardTest& test : card.tests) {
    const std::vector<ComparedYieldStress> compared = compared_yield_stresses(test);
    for (const ComparedYieldStress& one : compared) {
      if (!one.reading_pa && !test.yield_stress) continue;
      out += format("  %-24s %10s %10s %10.0f Pa  %s\n", reading_name(test, one.reading).c_str(),
                    one.reading_pa ? format("%.0f", *one.reading_pa).c_str() : "-", "", one.simulated_pa,
                    std::string(one.formula).c_str());
    }
    out += measured_yield_stress_lines(test, compared);
  }
  return out.empty() ? out : "Yield stress of a fluid with this reading (for comparison, not fitted)\n" + out;
}

std::string hold_out_lines(const Card& card) {
  std::string out;
  for (const auto& test : card.tests)
    if (test.within_noise) out += "Validation test " + hold_out_in_words(test) + ".\n";
  return out;
}

/// Notes on the measurements taken together.
std::string remark_lines(const Card& card) {
  std::string out;
  for (const auto& test : card.tests) {
    const auto say = [&](const std::string& remark) { out += heading_of(test) + remark + ".\n"; };
    if (test.lab.twin) say("The data of the laboratory file come from a simulation (a twin)");
    for (const std::string& note : check_readings(test.test, laboratory_measurements(test)).remarks())
      say("Laboratory: " + note);
  }
  return out;
}

/// Measurements that were not fitted, with their differences.
std::string unfitted_words(const Card& card) {
  std::string out;
  for (const auto& test : card.tests)
    for (const auto& one : test.readings) {
      if (!one.measured || one.weight > 0 || test.hold_out) continue;
      const double off = std::abs(one.simulated - *one.measured);
      out += " " + (test.name.empty() ? "" : test.name + "/") + one.name + " was not fitted and is " +
             format("%.3g%s off", off, is_length(one.name) ? " mm" : "");
      if (off <= one.standard_deviation)
        out += ", within its standard deviation";
      else if (one.standard_deviation > 0)
        out += format(", %.2g standard deviations", off / one.standard_deviation);
      out += ".";
    }
  return out;
}

std::string verdict_on_fitted(const Card& card) {
  const auto& confirmation = card.confirmation;
  const ErrorUnit unit = error_unit_of(card);
  const auto packings = confirmation.packings.size();
  if (packings == 0) return "Not simulated. " + card.search.reason;
  std::size_t accepted = packings;
  for (const CardTest& test : card.tests)
    for (const CardReading& one : test.readings)
      if (one.measured && one.weight > 0 && !test.hold_out)
        accepted = std::min(accepted, static_cast<std::size_t>(one.packings));
  const std::string largest =
      "largest error " +
      (unit.tolerance_mm ? unit.words(confirmation.error, "%.2f") + " of the " + unit.words(1, "%.3g") + " allowed"
                         : format("%.2f of its tolerance", confirmation.error)) +
      (packings == 1         ? " (one packing, error unknown)"
       : accepted < packings ? format(" (mean of %zu of %zu packings)", accepted, packings)
                             : format(" (mean of %zu packings)", packings));
  if (confirmation.meets_laboratory)
    return std::string("The material reproduces the measurement") +
           (reservations_on(card).empty() ? "" : ", with reservations") + ": " + largest + ".";
  if (!confirmation.fresh)
    return "Not confirmed on fresh packings: " + largest + " (mean over packings that the search has used). " +
           card.search.reason;
  if (only_heaps_refute(card))
    return "The readings are within their tolerances, but " + cause_unconfirmed(card) + ": " + largest + ". " +
           card.search.reason;
  if (confirmation.error <= 1 && !confirmation.refuted)
    return "It is uncertain whether the material reproduces the measurement: " + cause_unconfirmed(card) + ": " +
           largest + ". " + card.search.reason;
  return "The material does not reproduce the measurement: " + cause_unconfirmed(card) + ": " + largest + ". " +
         card.search.reason;
}

std::string reservation_lines(const Card& card) {
  std::string out;
  for (const std::string& one : reservations_on(card)) out += "Reservation: " + one + ".\n";
  return out;
}

}  // namespace

std::string hold_out_in_words(const CardTest& test) {
  return test.name + (*test.within_noise ? ": predicted within the noise of both"
                                         : ": not predicted; the difference is more than the noise of both");
}

std::string verdict_of(const Card& card) {
  if (card.interpolated)
    return interpolation_in_words(*card.interpolated) +
           ". The mix was not measured: measure it, and compare the card with it (pastefit check --against).";
  const std::string next = what_to_try(card);
  return verdict_on_fitted(card) + unfitted_words(card) + (next.empty() ? "" : " What to try now: " + next + ".");
}

std::string summary_of(const Card& card, const std::string& findings) {
  std::string out = one_line(card.title) + "\n\n" + type_in_lines(card) + "\n" + parameter_lines(card) + "\n" +
                    reading_lines(card) + yield_stress_lines(card) + "\n" + findings + (findings.empty() ? "" : "\n");
  if (card.interpolated) return wrapped(lines_of(out) + one_line(verdict_of(card)) + "\n");
  out += format("%d of %d simulations", card.search.simulations, card.search.budget);
  if (card.search.coarse_simulations > 0) out += format(" and %d with coarse grains", card.search.coarse_simulations);
  if (card.search.failures.empty()) out += ", none failed";
  for (const auto& [reason, count] : card.search.failures) out += format(", %d failed (%s)", count, reason.c_str());
  out += ". Strategy " + one_line(card.search.strategy + ": " + card.search.status) + ".\n";
  return wrapped(lines_of(out + remark_lines(card) + hold_out_lines(card) + reservation_lines(card)) +
                 one_line(verdict_of(card)) + "\n");
}

}  // namespace pastefit
