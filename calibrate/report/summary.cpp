#include "calibrate/report/summary.h"

#include <array>
#include <cmath>

#include "calibrate/report/format.h"

namespace pastefit {

namespace {

std::string bridge_lines(const SlumpTable& test) {
  const auto& bridge = test.contact.bridge;
  const std::array<std::pair<const char*, double>, 6> lines{
      {{"a_n_m2", bridge.a_n_m2},
       {"b_n_m", bridge.b_n_m},
       {"c_n", bridge.c_n},
       {"d_c_m", bridge.d_c_m},
       {"offset_m", bridge.offset_m},
       {"cohesion_n", test.contact.cohesion_n.value_or(bridge.c_n)}}};
  std::string out = format("Contact law in SI, for grains of %g mm radius\n", 1e3 * test.grains.radius_m);
  for (const auto& [name, value] : lines) out += format("  %-24s %14.6g\n", name, value);
  return out;
}

std::string parameter_lines(const Card& card) {
  std::string out = "Scale-free, the same law for every grain size\n";
  for (const auto& parameter : card.parameters) {
    out += format("  %-24s %14.6g", parameter.name.c_str(), parameter.value);
    out += parameter.free ? format("   fitted, %g to %g\n", parameter.lower, parameter.upper) : "   fixed\n";
  }
  return out;
}

std::string observable_lines(const Card& card) {
  const auto packings = static_cast<double>(card.confirmation.packings.size());
  std::string out =
      format("%-26s %10s %10s %22s %12s\n", "Reading", "measured", "+- sd", "simulated +- std error", "difference");
  for (const auto& observable : card.observables) {
    const double error = observable.simulated_standard_deviation / std::sqrt(packings);
    out += format("  %-24s ", observable.name.c_str());
    out += observable.measured ? format("%10.4g %10.3g ", *observable.measured, observable.standard_deviation)
                               : format("%10s %10s ", "-", "-");
    out += format("%12.5g +- %-6.2g", observable.simulated, error);
    if (observable.measured)
      out += format(" %+12.3g%s", observable.simulated - *observable.measured,
                    observable.weight > 0 ? "" : "   (not fitted)");
    out += "\n";
  }
  return out;
}

}  // namespace

std::string verdict_of(const Card& card) {
  const auto& confirmation = card.confirmation;
  const auto misfit = format("%.2f mm over %zu packings, asked for %.2f mm", confirmation.misfit_mm,
                             confirmation.packings.size(), confirmation.tolerance_mm);
  if (confirmation.meets_laboratory) return "The material meets the laboratory: " + misfit + ".";
  if (!confirmation.fresh)
    return "Not confirmed on fresh packings: " + misfit + ", on packings that the search has seen. " +
           card.search.reason;
  return "The material does not meet the laboratory: " + misfit + ". " + card.search.reason;
}

std::string summary_of(const Card& card, const std::string& findings) {
  std::string out = card.title + "\n\n" + bridge_lines(card.test) + "\n" + parameter_lines(card) + "\n" +
                    observable_lines(card) + "\n" + findings + (findings.empty() ? "" : "\n");
  out += format("%d of %d simulations", card.search.simulations, card.search.budget);
  if (card.search.failures.empty()) out += ", none failed";
  for (const auto& [reason, count] : card.search.failures) out += format(", %d failed (%s)", count, reason.c_str());
  out += ". Strategy " + card.search.strategy + ": " + card.search.status + ".\n";
  if (card.provenance.lab.twin) out += "The laboratory's data were made by a simulation (a twin).\n";
  return out + verdict_of(card) + "\n";
}

}  // namespace pastefit
