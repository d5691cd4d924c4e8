#include "calibrate/report/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

std::string parameter_lines(const Card& card) {
  std::string out = "Scale-free parameters, the same for every grain size\n";
  for (const auto& parameter : card.material.parameters) {
    if (!has_parameter(card, parameter.name)) continue;
    out += format("  %-24s %14.6g", parameter.name, parameter.value);
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
    out += format("  %-24s ", reading.name);
    out += reading.measured ? format("%10.4g %10.3g ", *reading.measured, reading.standard_deviation)
                            : format("%10s %10s ", "-", "-");
    out += format("%10.5g ", reading.simulated.mean) + (error ? format("+- %-6.2g", *error) : std::string(9, ' '));
    if (reading.measured)
      out +=
          format(" %+9.3g%s", reading.simulated.mean - *reading.measured, reading.weight > 0 ? "" : "   (not fitted)");
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
  std::string out = format("  %-24s %10.4g %10.3g %10s Pa  measured\n", reading_name(test, "yield_stress_pa"),
                           test.yield_stress->value, test.yield_stress->standard_deviation, "-");
  for (const ComparedYieldStress& one : compared)
    out += format("    by %s: %.2g times the measured one, %+.2g standard deviations\n", one.reading, *one.ratio,
                  *one.deviations);
  return out;
}

/// Yield stresses from measured and simulated readings.
std::string yield_stress_lines(const Card& card) {
  std::string out;
  for (const CardTest& test : card.tests) {
    const std::vector<ComparedYieldStress> compared = compared_yield_stresses(test);
    for (const ComparedYieldStress& one : compared) {
      if (!one.reading_pa && !test.yield_stress) continue;
      out += format("  %-24s %10s %10s %10.0f Pa  %s\n", reading_name(test, one.reading),
                    one.reading_pa ? format("%.0f", *one.reading_pa) : "-", "", one.simulated_pa,
                    std::string(one.formula));
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
      const double off = std::abs(one.simulated.mean - *one.measured);
      out += " " + reading_name(test, one.name) + " was not fitted and is " +
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
        accepted = std::min(accepted, static_cast<std::size_t>(one.simulated.count));
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
  const std::string why = cause_unconfirmed(card) + ": " + largest + ". " + card.search.reason;
  if (only_heaps_refute(card)) return "The readings are within their tolerances, but " + why;
  if (confirmation.error <= 1 && !confirmation.refuted)
    return "It is uncertain whether the material reproduces the measurement: " + why;
  return "The material does not reproduce the measurement: " + why;
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
  out += format("The calibration used %d simulations (budget: %d)", card.search.simulations, card.search.budget);
  if (card.search.coarse_simulations > 0) out += format(" and %d with coarse grains", card.search.coarse_simulations);
  if (card.search.failures.empty()) out += "; none failed";
  for (const auto& [reason, count] : card.search.failures) out += format("; %d failed (%s)", count, reason);
  out += ". Strategy " + one_line(card.search.strategy + ": " + card.search.status) + ".\n";
  return wrapped(lines_of(out + remark_lines(card) + hold_out_lines(card) + reservation_lines(card)) +
                 one_line(verdict_of(card)) + "\n");
}

namespace {

BoundEnds bounds_in(const Card& card, const CardInference::Interval& interval) {
  const auto& parameters = card.material.parameters;
  const auto found = std::ranges::find(parameters, interval.parameter, &Parameter::name);
  return found == parameters.end() ? BoundEnds{} : ends_at_bounds(interval, *found);
}

std::string inference_lines(const Card& card) {
  const CardInference& inference = card.inference;
  std::string out = "Intervals of the parameters\n";
  if (inference.intervals.empty() && inference.not_identified.empty())
    return out + "  not calculated: other materials may fit the same readings\n";
  if (!inference.intervals.empty())
    out += format("  intervals of %g %% confidence (%s)\n", 100 * inference.level, inference.method);
  for (const auto& interval : inference.intervals)
    out += format("  %-24s ", interval.parameter) +
           interval_in_words(interval.lower, interval.upper, bounds_in(card, interval), 6) + "\n";
  for (const auto& [first, others] : inference.correlations)
    for (const auto& [second, value] : others) out += format("  %-24s %14.2f with %s\n", first, value, second);
  for (const auto& unseen : inference.not_identified)
    out += "  " + unseen.parameter + " is not identified: " + unseen.reason + "\n";
  return out;
}

std::string conditions_lines(const Card& card) {
  std::string out;
  for (const auto& test : card.tests) {
    const auto& grains = specimen_of(test.test).grains;
    const bool mono = grains.distribution == SizeDistribution::mono;
    out += (card.interpolated ? "For"
            : test.hold_out   ? "Predicted in"
                              : "Fitted in") +
           (test.name.empty() ? "" : " test " + test.name) + "\n" + conditions_in_words(test.test);
    out += mono ? format("  grains                   radius %g mm\n", 1e3 * grains.radius_m)
                : format("  grains                   radius %g to %g mm\n", 1e3 * grains.smallest_m,
                         1e3 * grains.largest_m);
  }
  return out + "  under other conditions the material is an extrapolation\n";
}

std::string origin_lines(const Card& card) {
  const auto& from = card.provenance;
  std::string out = "From\n";
  for (const auto& test : card.tests) {
    const std::string laboratory = test.name.empty() ? "laboratory" : "laboratory of " + test.name;
    out += format("  %-24s ", laboratory) + one_line(test.lab_file + " (" + test.lab_hash) + ")\n";
    if (!test.lab.source.empty()) out += "  its source               " + one_line(test.lab.source) + "\n";
  }
  out += "  study                    " + one_line(from.study_file + " (" + from.study_hash) + ")\n";
  for (const std::string& one : from.settings) out += "    with " + one_line(one) + "\n";
  return out + "  program                  " + one_line(from.program) + "\n";
}

std::string baseline_lines(const Card& card) {
  std::string out = "Baseline of checks\n";
  for (const auto& test : card.tests) {
    const auto& baseline = test.baseline;
    out += "  " + (test.name.empty() ? "" : test.name + ": ");
    if (baseline.runs.empty())
      out += "none: checks use the means and standard deviations of the readings above\n";
    else
      out += format("%zu packings, ", baseline.runs.size()) + baseline.program + ", " + baseline.machine + "\n";
  }
  for (const auto& change : card.rebaselined) {
    out += "  changed: " + one_line(change.why) + "\n";
    for (const auto& moved : change.moved)
      out += format("    %-24s %12.5g -> %.5g\n", moved.reading, moved.before, moved.after);
  }
  return out;
}

std::string rescaling_lines(const Card& card) {
  std::string out;
  for (const auto& step : card.rescaled) {
    out += format("Converted from grains of %g mm radius by the scaling rule\n", 1e3 * step.from_radius_m);
    if (step.bias.empty()) out += "  the bias of the readings was not measured\n";
    for (const auto& bias : step.bias)
      out +=
          format("  %-24s %12.5g -> %.5g, bias %+.3g", bias.reading, bias.before, bias.after,
                 bias.after - bias.before) +
          (bias.standard_error > 0 || card.confirmation.packings.size() > 1 ? format(" +- %.2g\n", bias.standard_error)
                                                                            : " (one packing, error unknown)\n");
  }
  return out;
}

/// Reason why a material with matching readings is not confirmed; empty if the readings do not match.
std::string doubt_about(const FurtherConfirmation& one) {
  const std::size_t heaps = one.packings.size(), rejected = heaps - static_cast<std::size_t>(one.accepted);
  if (one.meets_laboratory || *one.error > 1) return "";
  if (rejected > 0) return format("; %zu of %zu heaps sheared off", rejected, heaps);
  return format("; %zu packings are too few for a decision (--packings)", heaps);
}

}  // namespace

std::string further_confirmation_text(const FurtherConfirmation& one) {
  std::string out =
      "Simulated in another program: " + one_line(one.program) + (one.test.empty() ? "" : ", test " + one.test) + "\n";
  out += format("  grains of %g mm, %zu packings (%d heaps accepted), ranks: %d, %.3g core s, %.3g s\n",
                1e3 * one.radius_m, one.packings.size(), one.accepted, one.ranks, one.core_s, one.wall_s);
  for (const auto& reading : one.readings)
    out += format("  %-24s %12.5g -> %.5g, bias %+.3g", reading.name, reading.card, reading.simulated, reading.bias()) +
           (reading.standard_error ? format(" +- %.2g\n", *reading.standard_error) : " (error unknown)\n");
  if (!one.error) return out;
  return out + "  The material " + (one.meets_laboratory ? "reproduces" : "is not shown to reproduce") +
         format(" the measurement there: largest error %.2f of its tolerance", *one.error) + doubt_about(one) + ".\n";
}

std::string text_of(const Card& card) {
  const std::string unconfirmed = unconfirmed_line(card);
  std::string out = (unconfirmed.empty() ? "" : one_line(unconfirmed) + "\n\n") + summary_of(card);
  for (const auto& part :
       {inference_lines(card), conditions_lines(card), origin_lines(card), baseline_lines(card), rescaling_lines(card)})
    if (!part.empty()) out += "\n" + wrapped(lines_of(part));
  for (const auto& one : card.further_confirmations) out += "\n" + wrapped(further_confirmation_text(one));
  return out;
}

std::vector<Measurement> laboratory_measurements(const CardTest& test) {
  std::vector<Measurement> out;
  for (const CardReading& one : test.readings)
    if (one.measured) out.push_back({one.name, *one.measured, one.standard_deviation, one.repeats});
  return out;
}

std::string remarks_on(const CardTest& test) {
  std::vector<Readings> runs;
  for (const auto& run : test.baseline.runs) runs.push_back(run.readings);
  return remarks_on(test.test, runs);
}

}  // namespace pastefit
