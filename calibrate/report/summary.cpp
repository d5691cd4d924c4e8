#include "calibrate/report/summary.h"

#include <cmath>
#include <vector>

#include "calibrate/base/foreign_text.h"
#include "calibrate/base/format.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

/// The numbers of the law of the overlap, where it is not Hertz, and of the attraction across gaps.
std::string law_lines(const Material& material) {
  const ContactModel& contact = material.contact;
  const Bridge& bridge = contact.bridge;
  const double radius = material.grains.radius_m, at_touch = attraction_at_touch(bridge, radius);
  std::string out = format("Contact law in SI, for grains of %g mm radius\n", 1e3 * radius);
  const auto line = [&](const char* name, double value) { out += format("  %-24s %14.6g\n", name, value); };
  if (contact.normal != NormalLaw::hertz || bridge.shape != BridgeShape::polynomial)
    out += "  normal " + word_of(contact.normal, normal_laws) + ", attraction " + word_of(bridge.shape, bridge_shapes) +
           "\n";
  if (contact.surface_energy_j_m2 > 0) line("surface_energy_j_m2", contact.surface_energy_j_m2);
  if (contact.cohesion_energy_density_pa > 0) line("cohesion_energy_density_pa", contact.cohesion_energy_density_pa);
  if (bridge.shape == BridgeShape::polynomial) {
    line("a_n_m2", bridge.a_n_m2);
    line("b_n_m", bridge.b_n_m);
  }
  if (bridge.shape == BridgeShape::capillary) {
    line("liquid_volume_m3", bridge.liquid_volume_m3);
    line("surface_tension_n_m", bridge.surface_tension_n_m);
    line("contact_angle_rad", bridge.contact_angle_rad);
  }
  if (bridge.shape == BridgeShape::none) return out;
  line("c_n", at_touch);
  line("d_c_m", -rupture_gap(bridge, radius));
  line("offset_m", bridge.offset_m);
  line("cohesion_n", contact.cohesion_n.value_or(at_touch));
  return out;
}

std::string parameter_lines(const Material& material) {
  std::string out = "Scale-free, the same law for every grain size\n";
  for (const auto& parameter : material.parameters) {
    if (!has_parameter(material.contact, parameter.name)) continue;
    out += format("  %-24s %14.6g", parameter.name.c_str(), parameter.value);
    out += parameter.free ? format("   fitted, %g to %g", parameter.lower, parameter.upper) : "   fixed";
    if (const auto& prior = parameter.prior)
      out += format(", known as %g +- %g", prior->value, prior->standard_deviation);
    out += "\n";
  }
  return out;
}

std::string observable_lines(const std::vector<CardObservable>& observables, std::size_t packings) {
  std::string out;
  for (const auto& observable : observables) {
    const double error = observable.simulated_standard_deviation / std::sqrt(static_cast<double>(packings));
    out += format("  %-24s ", observable.name.c_str());
    out += observable.measured ? format("%10.4g %10.3g ", *observable.measured, observable.standard_deviation)
                               : format("%10s %10s ", "-", "-");
    out += format("%10.5g +- %-6.2g", observable.simulated, error);
    if (observable.measured)
      out += format(" %+9.3g%s", observable.simulated - *observable.measured,
                    observable.weight > 0 ? "" : "   (not fitted)");
    if (observable.band) out += format("   (noise explains +-%.3g)", *observable.band);
    out += "\n";
  }
  return out;
}

std::string reading_lines(const Card& card) {
  const auto packings = card.confirmation.packings.size();
  std::string out =
      format("%-26s %10s %10s %-20s%10s\n", "Reading", "measured", "+- sd", "simulated +- error", "difference");
  for (const auto& test : card.tests) {
    if (!test.name.empty()) out += "Test " + test.name + (test.hold_out ? ", held out: predicted, not fitted\n" : "\n");
    out += test.observables.empty() ? "  not simulated\n" : observable_lines(test.observables, packings);
  }
  return out;
}

std::string hold_out_lines(const Card& card) {
  std::string out;
  for (const auto& test : card.tests)
    if (test.within_noise)
      out += "Hold-out " + test.name +
             (*test.within_noise ? ": predicted within the noise of both.\n"
                                 : ": not predicted; the difference is more than the noise of both.\n");
  return out;
}

/// What a person should know of each test besides its readings, and of the laboratory's readings taken together.
std::string remark_lines(const Card& card) {
  std::string out;
  for (const auto& test : card.tests) {
    const auto say = [&](const std::string& remark) { out += heading_of(test) + remark + ".\n"; };
    if (test.lab.twin) say("The laboratory's data were made by a simulation (a twin)");
    std::vector<Measurement> measurements;
    for (const auto& one : test.observables)
      if (one.measured) measurements.push_back({one.name, *one.measured, one.standard_deviation, one.repeats});
    for (const std::string& note : doubts_about(test.test, measurements).notes) say("Laboratory: " + note);
    std::vector<Observables> runs;
    for (const auto& run : test.baseline.runs) runs.push_back(run.observables);
    if (const std::string on_runs = remarks_on(test.test, runs); !on_runs.empty()) say(on_runs);
  }
  return out;
}

/// What the laboratory measured and the search did not look at, with how far it is off.
std::string unfitted_words(const Card& card) {
  std::string out;
  for (const auto& test : card.tests)
    for (const auto& one : test.observables) {
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
  const MisfitUnit unit = misfit_unit_of(card);
  const auto misfit = unit.words(confirmation.misfit, "%.2f") +
                      format(" over %zu packings, asked for ", confirmation.packings.size()) + unit.words(1, "%.2f");
  if (confirmation.meets_laboratory) return "The material meets the laboratory: " + misfit + ".";
  if (!confirmation.fresh)
    return "Not confirmed on fresh packings: " + misfit + ", on packings that the search has seen. " +
           card.search.reason;
  if (confirmation.misfit <= 1)
    return "It is not sure that the material meets the laboratory: " + misfit + ". " + card.search.reason;
  return "The material does not meet the laboratory: " + misfit + ". " + card.search.reason;
}

}  // namespace

std::string verdict_of(const Card& card) {
  return verdict_on_fitted(card) + unfitted_words(card);
}

std::string summary_of(const Card& card, const std::string& findings) {
  std::string out = one_line(card.title) + "\n\n" + law_lines(card.material) + "\n" + parameter_lines(card.material) +
                    "\n" + reading_lines(card) + "\n" + findings + (findings.empty() ? "" : "\n");
  out += format("%d of %d simulations", card.search.simulations, card.search.budget);
  if (card.search.coarse_simulations > 0) out += format(" and %d with coarse grains", card.search.coarse_simulations);
  if (card.search.failures.empty()) out += ", none failed";
  for (const auto& [reason, count] : card.search.failures) out += format(", %d failed (%s)", count, reason.c_str());
  out += ". Strategy " + one_line(card.search.strategy + ": " + card.search.status) + ".\n";
  return lines_of(out + remark_lines(card) + hold_out_lines(card)) + one_line(verdict_of(card)) + "\n";
}

}  // namespace pastefit
