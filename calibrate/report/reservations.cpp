#include "calibrate/report/reservations.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/card/standing.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

std::vector<Readings> runs_of(const CardTest& test) {
  std::vector<Readings> runs;
  for (const auto& run : test.baseline.runs) runs.push_back(run.readings);
  return runs;
}

void add_marginal_readings(const CardTest& test, std::vector<std::string>& out) {
  for (const CardReading& one : test.readings) {
    const auto error = standard_error(one);
    if (!one.measured || one.weight <= 0 || test.hold_out || !error) continue;
    const double off = std::abs(one.simulated - *one.measured);
    if (off > one.tolerance || off + *error <= one.tolerance) continue;
    out.push_back(reading_name(test, one.name) + " is off by " + plain(off) + " +- " + plain(*error, 2) + " of the " +
                  plain(one.tolerance) + " allowed");
  }
}

void add_bounds(const Card& card, std::vector<std::string>& out) {
  for (const AtBound& one : parameters_at_bounds(card))
    out.push_back(one.parameter + " " + plain(one.value) + " is at its " + (one.upper ? "upper" : "lower") + " bound");
}

void add_implausible(const Card& card, std::vector<std::string>& out) {
  for (const PlausibleRange& range : plausible_ranges())
    for (const Parameter& one : card.material.parameters) {
      if (one.name != range.name || !one.free || !has_parameter(card, one.name)) continue;
      const std::string value = one.name + " " + plain(one.value) + ", plausible " + plain(range.smallest) + " to " +
                                plain(range.largest) + ": ";
      if (one.value < range.smallest) out.push_back(value + std::string(range.below));
      if (one.value > range.largest) out.push_back(value + std::string(range.above));
    }
}

/// What has no strength of its own in Pa was calibrated at one pressure.
void add_pressure(const Card& card, std::vector<std::string>& out) {
  const ContactModel& contact = card.material.contact;
  const bool yields = contact.normal == NormalLaw::epa || contact.normal == NormalLaw::luding;
  if (!yields || contact.cohesion_n.value_or(0) > 0) return;
  double largest_pa = 0;
  for (const CardTest& test : card.tests)
    largest_pa = std::max(largest_pa, conditions_of(test.test).value("largest_pressure_pa", 0.0));
  out.push_back("the adhesion of this law grows with the pressure: the card holds near that of its tests" +
                (largest_pa > 0 ? ", at most " + plain(1e-3 * largest_pa) + " kPa" : "") +
                "; a thin layer of paste is stronger than it says");
}

}  // namespace

std::vector<std::string> reservations_on(const Card& card) {
  std::vector<std::string> out;
  for (const CardTest& test : card.tests)
    if (const std::string remarks = remarks_on(test.test, runs_of(test)); !remarks.empty())
      out.push_back(heading_of(test) + remarks);
  for (const CardTest& test : card.tests) add_marginal_readings(test, out);
  add_bounds(card, out);
  add_implausible(card, out);
  add_pressure(card, out);
  if (card.confirmation.packings.size() == 1) out.push_back("one packing, error unknown");
  return out;
}

}  // namespace pastefit
