#include "calibrate/card/standing.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/card/card_description.h"
#include "calibrate/laboratory/test.h"

namespace pastefit {

namespace {

bool is_fitted(const CardReading& one) {
  return one.measured && one.weight > 0 && one.tolerance > 0;
}

/// Fitted reading with the largest error.
struct Farthest {
  std::string name;
  double off = 0, tolerance = 1;
  double share() const { return off / tolerance; }
};

Farthest farthest_of(const Card& card) {
  Farthest farthest;
  for (const CardTest& test : card.tests) {
    if (test.hold_out) continue;
    for (const CardReading& one : test.readings) {
      if (!is_fitted(one)) continue;
      const Farthest this_one{reading_name(test, one.name), std::abs(one.simulated.mean - *one.measured),
                              one.tolerance};
      if (farthest.name.empty() || this_one.share() > farthest.share()) farthest = this_one;
    }
  }
  return farthest;
}

std::string off_in_words(const Farthest& one) {
  const char* unit = is_length(one.name) ? " mm" : "";
  return one.name + " is off by " + format("%.3g%s, %.3g%s allowed", one.off, unit, one.tolerance, unit);
}

/// Fitted test with the most rejected runs.
struct Rejected {
  const CardTest* test = nullptr;
  std::size_t runs = 0, of = 0;
};

Rejected rejected_of(const Card& card) {
  Rejected most;
  for (const CardTest& test : card.tests) {
    if (test.hold_out) continue;
    const auto rejected = std::ranges::count_if(
        test.baseline.runs, [&](const Baseline::Run& run) { return is_rejected(test.test, run.readings); });
    const Rejected here{&test, static_cast<std::size_t>(rejected), test.baseline.runs.size()};
    if (!most.test || here.runs > most.runs) most = here;
  }
  return most;
}

/// "1 in 5", or per cent.
std::string share_in_words(double share) {
  const double one_in = 1 / share;
  return std::abs(one_in - std::round(one_in)) < 0.01 ? format("1 in %.0f", one_in) : format("%.3g %%", 100 * share);
}

std::string rejected_in_words(const Card& card) {
  const Rejected rejected = rejected_of(card);
  const auto& share = card.confirmation.rejected_share;
  const auto rejected_runs_of = [](const auto& test) { return std::string(rejected_runs(test)); };
  const std::string heaps = rejected.test ? std::visit(rejected_runs_of, rejected.test->test) : "runs rejected";
  const std::string allowed = share ? ", " + share_in_words(*share) + " allowed" : "";
  return format("%zu of %zu ", rejected.runs, rejected.of) + heaps +
         (rejected.runs == 0 ? ", but all came close to it" : "") + allowed;
}

}  // namespace

Evidence evidence_of(std::span<const CardTest> tests) {
  Evidence out;
  std::vector<double> indices;
  for (const CardTest& test : tests) {
    if (test.hold_out) continue;
    for (const CardReading& one : test.readings)
      if (is_fitted(one))
        out.add_reading(one.simulated.mean - *one.measured, standard_error(one).value_or(0), one.tolerance);
    indices.resize(std::max(indices.size(), test.baseline.runs.size()), std::nan(""));
    for (std::size_t i = 0; i < test.baseline.runs.size(); ++i)
      indices[i] =
          std::fmax(indices[i], rejection_index(test.test, test.baseline.runs[i].readings).value_or(std::nan("")));
  }
  for (const double index : indices) out.add_heap(index);
  return out;
}

Confirmation confirmation_by(const Card& card, std::span<const CardTest> tests, std::vector<std::uint64_t> packings) {
  const Evidence evidence = evidence_of(tests);
  const auto may_be = [](const CardTest& one) { return !one.hold_out && rejection_index(one.test, {}).has_value(); };
  // 1: no fitted test rejects heaps
  const double share = std::ranges::none_of(tests, may_be)
                           ? 1
                           : card.confirmation.rejected_share.value_or(SearchOptions{}.rejected_share);
  const Verdict verdict = verdict_on(evidence, share);
  const bool of_laboratory = evidence.readings > 0 && !card.interpolated;
  return {std::move(packings),
          true,
          evidence.error,
          of_laboratory && verdict == Verdict::meets,
          of_laboratory && verdict == Verdict::refuted,
          share};
}

/// A fitted value within a hundredth of its range counts as at the bound: searches rarely end exactly on it.
std::vector<AtBound> parameters_at_bounds(const Card& card) {
  constexpr double near = 0.01;
  std::vector<AtBound> out;
  for (const Parameter& one : card.material.parameters) {
    if (!one.free || !has_parameter(card, one.name)) continue;
    const auto along = [&](double value) { return one.scale == Scale::logarithmic ? std::log(value) : value; };
    const double share = (along(one.value) - along(one.lower)) / (along(one.upper) - along(one.lower));
    if (share <= near || share >= 1 - near) out.push_back({one.name, one.value, share > near});
  }
  return out;
}

std::string at_bound_in_words(const AtBound& one) {
  return one.parameter + " " + plain(one.value) + " is at its " + (one.upper ? "upper" : "lower") + " bound";
}

std::string what_to_try(const Card& card) {
  const Confirmation& confirmation = card.confirmation;
  if (card.interpolated || confirmation.meets_laboratory) return "";
  if (!card.rescaled.empty() && !confirmation.fresh)
    return "calibrate with grains of this size, or measure the bias (pastefit rescale --packings)";
  if (!confirmation.fresh) return "continue with --resume and a larger search.budget_simulations";
  const Farthest farthest = farthest_of(card);
  const Verdict of_readings = verdict_on_readings(evidence_of(card.tests));
  if (of_readings == Verdict::undecided) return "more packings of the confirmation (search.confirmation_packings)";
  std::string bounds;
  for (const AtBound& one : parameters_at_bounds(card))
    bounds += (bounds.empty() ? "" : ", ") + std::string(one.upper ? "a higher upper" : "a lower lower") +
              " bound of " + one.parameter + " (" + shown(one.value) + " now)";
  const std::string wider = bounds.empty() ? "" : bounds + "; ";
  if (of_readings == Verdict::refuted)
    return wider + "check " + farthest.name +
           " and its standard deviation, free another parameter, or allow more "
           "simulations (search.budget_simulations)";
  return wider +
         "wider bounds of the frictions, or more simulations (search.budget_simulations); if the measured heaps shear "
         "off too, a larger search.rejected_share";
}

bool only_heaps_refute(const Card& card) {
  const Farthest farthest = farthest_of(card);
  const bool fresh = card.confirmation.fresh && !card.interpolated;
  return fresh && card.confirmation.refuted && card.confirmation.error <= 1 && farthest.share() <= 1;
}

std::string cause_unconfirmed(const Card& card) {
  const Confirmation& confirmation = card.confirmation;
  if (card.interpolated)
    return "interpolated between " + std::to_string(card.interpolated->studies.size()) +
           " materials; the mix was not measured";
  if (confirmation.meets_laboratory) return "";
  if (!card.rescaled.empty() && !confirmation.fresh)
    return format("converted from grains of %.4g mm radius, and not calibrated with the new ones",
                  1e3 * card.rescaled.back().from_radius_m);
  if (!confirmation.fresh) return "not simulated on fresh packings";
  const Farthest farthest = farthest_of(card);
  const Verdict of_readings = verdict_on_readings(evidence_of(card.tests));
  if (of_readings == Verdict::refuted) return off_in_words(farthest);
  if (confirmation.refuted) return rejected_in_words(card);
  if (of_readings == Verdict::undecided)
    return off_in_words(farthest) + "; the packings scatter too much to be certain";
  return rejected_in_words(card) + "; more packings are needed to be certain";
}

std::string unconfirmed_line(const Card& card) {
  const std::string cause = cause_unconfirmed(card);
  return cause.empty() ? "" : "NOT CONFIRMED: " + cause;
}

std::vector<ComparedYieldStress> compared_yield_stresses(const CardTest& test) {
  Readings measured, simulated;
  for (const CardReading& one : test.readings) {
    simulated.set(one.name, one.simulated.mean);
    if (one.measured) measured.set(one.name, *one.measured);
  }
  const std::vector<YieldStress> of_laboratory = yield_stresses_of(test.test, measured);
  std::vector<ComparedYieldStress> out;
  for (const YieldStress& one : yield_stresses_of(test.test, simulated)) {
    ComparedYieldStress compared{one.reading, one.formula, one.pa, {}, {}, {}};
    const auto same = std::ranges::find(of_laboratory, one.reading, &YieldStress::reading);
    if (same != of_laboratory.end()) compared.reading_pa = same->pa;
    if (const auto& known = test.yield_stress) {
      compared.ratio = one.pa / known->value;
      compared.deviations = (one.pa - known->value) / known->standard_deviation;
    }
    out.push_back(std::move(compared));
  }
  return out;
}

nlohmann::ordered_json yield_stresses_json(const CardTest& test) {
  const char* const key = "yield_stress_pa";
  nlohmann::ordered_json holder;
  OrderedObjectWriter writer(holder);
  card_fields::describe_yield_stresses(writer, key, compared_yield_stresses(test));
  return holder[key];
}

nlohmann::ordered_json with_yield_stresses(const Card& card) {
  nlohmann::ordered_json out = to_json(card);
  for (std::size_t i = 0; i < card.tests.size(); ++i)
    if (auto stresses = yield_stresses_json(card.tests[i]); !stresses.empty())
      out["tests"][i]["yield_stress_pa"] = std::move(stresses);
  return out;
}

nlohmann::ordered_json yield_stresses_json(const Test& test, const Readings& readings) {
  nlohmann::ordered_json out;
  for (const YieldStress& one : yield_stresses_of(test, readings))
    out[one.reading] = {{"formula", one.formula}, {"simulated", one.pa}};
  return out;
}

}  // namespace pastefit
