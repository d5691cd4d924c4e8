#include "calibrate/card/card.h"

#include <algorithm>
#include <cmath>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

std::optional<double> standard_error(const CardReading& reading) {
  if (reading.simulated.count < 2) return std::nullopt;
  return reading.simulated.standard_deviation / std::sqrt(static_cast<double>(reading.simulated.count));
}

std::vector<double> column_of(const std::vector<Baseline::Run>& runs, std::string_view name) {
  std::vector<double> column;
  for (const auto& run : runs)
    if (const auto value = run.readings.find(name)) column.push_back(*value);
  return column;
}

std::vector<double> values_of(const Material& material) {
  std::vector<double> values;
  for (const auto& parameter : material.parameters) values.push_back(parameter.value);
  return values;
}

bool has_parameter(const Card& card, std::string_view name) {
  return has_parameter(card.material.contact, name) &&
         std::ranges::any_of(card.tests, [&](const CardTest& test) { return acts_in(test.test, name); });
}

std::string heading_of(const CardTest& test) {
  return test.name.empty() ? "" : "Test " + test.name + ": ";
}

std::string packings_in_words(const Card& card, const CardTest& test) {
  const auto packings = static_cast<int>(card.confirmation.packings.size());
  int accepted = packings;
  for (const CardReading& one : test.readings) accepted = std::min(accepted, one.simulated.count);
  if (packings <= 1) return packings == 1 ? "one packing, error unknown" : "";
  const std::string of =
      (accepted < packings ? format("%d of ", accepted) : "") + format("the card's %d packings", packings);
  return accepted == 1 ? of + ", error unknown" : "mean +- standard deviation of " + of;
}

ErrorUnit error_unit_of(const Card& card) {
  std::vector<std::pair<std::string_view, double>> fitted;
  for (const auto& test : card.tests) {
    if (test.hold_out) continue;
    for (const auto& one : test.readings)
      if (one.measured && one.weight > 0) fitted.emplace_back(one.name, one.tolerance);
  }
  return error_unit_of(fitted);
}

std::string interpolation_in_words(const Interpolation& interpolation) {
  return "Interpolated, not confirmed: " + interpolation.variable + " " + shown(interpolation.value) + ", " +
         (interpolation.model == "linear" ? "linear" : "Gaussian process") + " between " +
         std::to_string(interpolation.studies.size()) + " materials";
}

std::string title_of(const Card& card) {
  return (card.interpolated ? interpolation_in_words(*card.interpolated) + ": " : "") + card.title;
}

BoundEnds ends_at_bounds(const CardInference::Interval& interval, const Parameter& parameter) {
  if (!parameter.free) return {};
  const auto is_bound = [](double end, double bound) { return end == bound || end == rounded(bound, 4); };
  return {is_bound(interval.lower, parameter.lower), is_bound(interval.upper, parameter.upper)};
}

std::string interval_in_words(double lower, double upper, const BoundEnds& at_bounds, int digits) {
  const auto end = [&](double value, bool bound) {
    return plain(value, digits) + (bound ? " (the study's bound)" : "");
  };
  return end(lower, at_bounds.lower) + " to " + end(upper, at_bounds.upper);
}

Study study_of(const Card& card) {
  Study study;
  study.title = card.title;
  study.parameters = card.material.parameters;
  study.hash = card.provenance.study_hash;
  study.search.strategy = card.search.strategy;
  study.search.seed = card.search.seed;
  study.search.packings = static_cast<int>(card.search.packings.size());
  study.search.budget_simulations = card.search.budget;
  for (const CardTest& of_card : card.tests) {
    StudyTest test;
    test.name = of_card.name;
    test.lab_file = of_card.lab_file;
    test.hold_out = of_card.hold_out;
    test.lab.provenance = of_card.lab;
    test.lab.test = of_card.test;
    test.lab.hash = of_card.lab_hash;
    for (const CardReading& one : of_card.readings) {
      if (!one.measured) continue;
      test.lab.measurements.push_back({one.name, *one.measured, one.standard_deviation, one.repeats});
      test.targets.push_back({one.name, one.weight, one.tolerance});
    }
    study.tests.push_back(std::move(test));
  }
  return study;
}

Eigen::VectorXd point_of(const Card& card) {
  std::vector<double> point;
  for (const Parameter& parameter : card.material.parameters)
    if (parameter.free) point.push_back(std::clamp(unit_of(parameter, parameter.value), 0.0, 1.0));
  return Eigen::Map<const Eigen::VectorXd>(point.data(), std::ssize(point));
}

Card with_other_material(Card card, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) card.material.parameters[i].value = values[i];
  Test own_grains = card.tests.front().test;
  specimen_of(own_grains).grains = card.material.grains;
  card.material.contact = specimen_of(with_contact_of(std::move(own_grains), values)).contact;
  for (CardTest& test : card.tests) {
    test.test = with_contact_of(std::move(test.test), values);
    test.readings.clear();
    test.within_noise.reset();
    test.baseline = {};
  }
  card.confirmation = {};
  card.inference = {};
  card.rebaselined.clear();
  card.further_confirmations.clear();
  return card;
}

Result<Card> rescaled(Card card, double radius) {
  const auto has_that_size = [](const CardTest& test) { return !why_of_that_size(test.test).empty(); };
  if (const auto of_its_size = std::ranges::find_if(card.tests, has_that_size);
      of_its_size != card.tests.end() &&
      specimen_of(of_its_size->test).grains.radius_m == card.material.grains.radius_m)
    return Fault{"tests[" + std::to_string(of_its_size - card.tests.begin()) + "].test",
                 std::string(why_of_that_size(of_its_size->test)),
                 "keep its grains; in a test of many grains the same material is another card"};
  const double old_radius = card.material.grains.radius_m, s = radius / old_radius;
  const auto carry = [&](GrainSizes& grains, ContactModel& contact) {
    const bool of_that_radius = grains.radius_m == old_radius;
    grains = enlarged(grains, s);
    if (of_that_radius) grains.radius_m = radius;  // avoids the rounding of s
    contact = enlarged(contact, s);
  };
  carry(card.material.grains, card.material.contact);
  card.rescaled.push_back({old_radius, {}});
  Faults all;
  for (CardTest& test : card.tests) {
    Specimen& specimen = specimen_of(test.test);
    if (!has_that_size(test)) carry(specimen.grains, specimen.contact);
    test.readings.clear();
    test.within_noise.reset();
    test.baseline = {};
    for (Fault fault : validate(test.test)) {
      fault.where = heading_of(test) + fault.where;
      all.push_back(std::move(fault));
    }
  }
  if (!all.empty()) return all;
  card.confirmation.packings.clear();
  card.confirmation.fresh = card.confirmation.meets_laboratory = card.confirmation.refuted = false;
  card.confirmation.error = 0;
  card.search.reason = "The material was converted from grains of another size and is not confirmed for the new ones.";
  card.rebaselined.clear();
  card.further_confirmations.clear();
  return card;
}

}  // namespace pastefit
