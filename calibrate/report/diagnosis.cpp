#include "calibrate/report/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/card/standing.h"
#include "calibrate/inference/description.h"
#include "calibrate/report/summary.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

/// Calls `see` for each fitted reading.
template <class See>
void for_fitted(const Card& card, See see) {
  for (const CardTest& test : card.tests)
    for (const CardReading& one : test.readings)
      if (one.measured && one.weight > 0 && !test.hold_out) see(test, one);
}

/// Adds words on what is fine to the numbers, and others to the notes.
void enter_words(Diagnosis& out, bool fine, const std::string& words) {
  if (!fine) return out.notes.push_back(words);
  out.numbers += (out.numbers.empty() ? "" : "; ") + words;
}

Diagnosis heaps(const Card& card) {
  Diagnosis out{.name = "heaps sheared off",
                .may_be_ignored = "if the laboratory's heaps sheared off as often",
                .page = "when-it-does-not-meet.md#heaps-that-shear-off"};
  std::size_t runs = 0;
  for (const CardTest& test : card.tests) {
    if (const std::string remarks = remarks_on(test); !remarks.empty())
      out.reservations.push_back(heading_of(test) + remarks);
    if (rejection_index(test.test, {})) runs += test.baseline.runs.size();
  }
  if (runs == 0) out.unknown = "no heaps of a test that rejects any";
  out.numbers = format("none of %zu", runs);
  return out;
}

Diagnosis readings(const Card& card) {
  Diagnosis out{.name = "readings within tolerance",
                .may_be_ignored = "if the tolerance is smaller than the scatter of your own repeats",
                .page = "result.md#when-a-material-is-confirmed"};
  if (!card.confirmation.fresh) out.notes.push_back(cause_unconfirmed(card));
  std::string largest;
  for_fitted(card, [&](const CardTest& test, const CardReading& one) {
    const auto error = standard_error(one);
    const double off = std::abs(one.simulated.mean - *one.measured);
    const std::string words = reading_name(test, one.name) + " is off by " + plain(off) +
                              (error ? " +- " + plain(*error, 2) : "") + " of the " + plain(one.tolerance) + " allowed";
    if (off > one.tolerance)
      out.notes.push_back(words);
    else if (error && off + *error > one.tolerance)
      out.reservations.push_back(words);
  });
  if (card.confirmation.packings.empty()) out.unknown = "the material was not simulated";
  out.numbers = format("largest error %.2f of its tolerance, mean of %zu packings", card.confirmation.error,
                       card.confirmation.packings.size());
  return out;
}

Diagnosis bounds(const Card& card) {
  Diagnosis out{.name = "parameters at bounds",
                .may_be_ignored = "if values beyond the bound are known to be wrong",
                .page = "when-it-does-not-meet.md#out-of-reach"};
  for (const AtBound& one : parameters_at_bounds(card)) out.reservations.push_back(at_bound_in_words(one));
  const auto free = std::ranges::count_if(
      card.material.parameters, [&](const Parameter& one) { return one.free && has_parameter(card, one.name); });
  out.numbers = format("none of %td fitted", free);
  return out;
}

Diagnosis plausible(const Card& card) {
  Diagnosis out{.name = "frictions plausible",
                .may_be_ignored = "if the grains represent angular or coated ones, or are compared in this test only",
                .page = "choosing-a-law.md#what-is-plausible"};
  std::string known;
  for (const PlausibleRange& range : plausible_ranges())
    for (const Parameter& one : card.material.parameters) {
      if (one.name != range.name || !one.free || !has_parameter(card, one.name)) continue;
      const std::string value =
          one.name + " " + plain(one.value) + ", plausible " + plain(range.smallest) + " to " + plain(range.largest);
      if (one.value < range.smallest) out.reservations.push_back(value + ": " + std::string(range.below));
      if (one.value > range.largest) out.reservations.push_back(value + ": " + std::string(range.above));
      known += (known.empty() ? "" : "; ") + value;
    }
  out.numbers = known.empty() ? "none is fitted" : known;
  return out;
}

/// Adhesion without a strength in Pa was calibrated at one pressure.
Diagnosis pressure(const Card& card) {
  Diagnosis out{.name = "valid at any pressure",
                .may_be_ignored = "if the material is used at pressures like those of the test",
                .page = "choosing-a-law.md"};
  out.numbers = "the attraction does not depend on it";
  const ContactModel& contact = card.material.contact;
  const bool yields = contact.normal == NormalLaw::epa || contact.normal == NormalLaw::luding;
  if (!yields || contact.cohesion_n.value_or(0) > 0) return out;
  double largest_pa = 0;
  for (const CardTest& test : card.tests)
    largest_pa = std::max(largest_pa, conditions_of(test.test).value("largest_pressure_pa", 0.0));
  out.reservations.push_back("the adhesion of this law grows with the pressure: the card holds near that of its tests" +
                             (largest_pa > 0 ? ", at most " + plain(1e-3 * largest_pa) + " kPa" : "") +
                             "; a thin layer of paste is stronger than it says");
  return out;
}

/// "step1.height_mm 4.8 mm, published 7.6 mm".
std::string beside_published(const std::string& name, double deviation, const ReadingKind& kind) {
  const auto unit = unit_of_key(kind.key);
  const std::string end = unit ? " " + std::string(unit->name) : "";
  return name + " " + plain(deviation, 2) + end + ", published " + plain(kind.published_deviation, 2) + end;
}

/// Compares the scatter of each fitted reading, `sample_in`, with the published repeatability of the test.
template <class SampleIn>
void judge_scatter(const Card& card, Diagnosis& out, SampleIn sample_in) {
  for_fitted(card, [&](const CardTest& test, const CardReading& one) {
    const auto kinds = reading_kinds(test.test);
    const ReadingKind* kind = find_kind(kinds, one.name);
    const Sample sample = sample_in(one);
    if (!kind || kind->published_deviation == 0 || sample.count < 2) return;
    enter_words(out, !(least_deviation(sample) > kind->published_deviation),
                beside_published(reading_name(test, one.name), sample.standard_deviation, *kind));
  });
}

Diagnosis packings(const Card& card) {
  Diagnosis out{.name = "scatter between packings",
                .may_be_ignored = "if the mean over many heaps is used, as the confirmation does",
                .page = "theory.md#noise-of-packings"};
  judge_scatter(card, out, [](const CardReading& one) { return one.simulated; });
  const auto count = card.confirmation.packings.size();
  if (count == 1) out.reservations.push_back("one packing, error unknown");
  if (count == 0) out.unknown = "the material was not simulated";
  if (count > 1 && out.numbers.empty()) out.unknown = "no repeatability of these readings is published";
  return out;
}

Diagnosis repeats(const Card& card) {
  Diagnosis out{.name = "scatter of the measurement",
                .may_be_ignored = "if the batches differ and the card is for their mean",
                .page = "measuring.md#in-the-laboratory"};
  judge_scatter(card, out, [](const CardReading& one) {
    return Sample{one.repeats, *one.measured, one.standard_deviation};
  });
  if (out.numbers.empty()) out.unknown = "the measurement has no repeats, or no repeatability is published";
  return out;
}

/// What the measured readings say together, e.g. of the shape of a heap.
Diagnosis measured_together(const Card& card) {
  Diagnosis out{.name = "measured readings together",
                .may_be_ignored = "if they were read on one heap, and the simulated ones are within tolerance",
                .page = "when-it-does-not-meet.md#readings-that-no-heap-can-have"};
  for (const CardTest& test : card.tests)
    for (const std::string& note : check_readings(test.test, laboratory_measurements(test)).doubts)
      out.notes.push_back(heading_of(test) + note);
  out.numbers = "nothing unusual";
  return out;
}

Diagnosis intervals(const Card& card) {
  Diagnosis out{.name = "intervals",
                .may_be_ignored = "if the card is used for such tests only, in which these parameters compensate",
                .page = "result.md#the-summary-part-by-part"};
  for (const auto& one : card.inference.not_identified)
    out.notes.push_back(one.parameter + " is not identifiable: " + one.reason);
  const std::size_t known = card.inference.intervals.size();
  if (known + out.notes.size() == 0) out.unknown = "not calculated";
  std::vector<std::string> with_prior;
  for (const Parameter& one : card.material.parameters)
    if (one.free && one.prior) with_prior.push_back(one.name);
  out.numbers =
      format("%zu parameters", known) +
      (with_prior.empty() ? ", by the readings" : ", by the readings and priors of " + enumerated(with_prior));
  return out;
}

Diagnosis validation(const Card& card) {
  Diagnosis out{.name = "validation test",
                .may_be_ignored = "if the card is not used for such a test",
                .page = "several-tests.md"};
  for (const CardTest& test : card.tests)
    if (test.within_noise) enter_words(out, *test.within_noise, hold_out_in_words(test));
  if (out.numbers.empty()) out.unknown = "the study has no test with \"hold_out\"";
  return out;
}

/// Fewer of the largest grains than this across the narrowest opening bridge it: the presets have five.
constexpr double kGrainsAcross = 4.5;

Diagnosis grains(const Card& card) {
  Diagnosis out{.name = "number of grains",
                .may_be_ignored = "if the material is used with as few grains across",
                .page = "other-programs.md#other-grains"};
  for (const CardTest& test : card.tests) {
    if (test.hold_out) continue;
    if (const std::string note = note_on_grain_count(test.test); !note.empty())
      out.notes.push_back(heading_of(test) + note);
    const auto opening_m = std::visit([](const auto& one) { return narrowest_opening_m(one); }, test.test);
    if (!opening_m) continue;
    const double across = *opening_m / (2 * largest_radius(specimen_of(test.test).grains));
    enter_words(out, !(across < kGrainsAcross),
                heading_of(test) + plain(grains_needed(test.test), 2) + " grains, " + plain(across, 2) +
                    " of the largest across the narrowest opening");
  }
  if (out.numbers.empty()) out.unknown = "these tests have no opening";
  return out;
}

/// The program chooses its step; one that is too long for a contact creates energy.
Diagnosis time_step(const Card& card, std::span<const StoredEvaluation> evaluations) {
  Diagnosis out{.name = "time step",
                .may_be_ignored = "if only a few simulations, far from the card's parameters, failed",
                .page = "when-it-does-not-meet.md#simulations-that-fail"};
  for (const FailureReason reason : {FailureReason::energy_created, FailureReason::energy_lost})
    if (const auto found = card.search.failures.find(std::string(name_of(reason)));
        found != card.search.failures.end() && found->second > 0)
      out.notes.push_back(format("%d of %d simulations failed with ", found->second, card.search.simulations) +
                          found->first);
  double largest = 0;
  int whole = 0;
  for (const StoredEvaluation& one : evaluations)
    if (!one.failure && one.run.energy_error) {
      largest = std::max(largest, std::abs(*one.run.energy_error));
      ++whole;
    }
  if (out.notes.empty()) out.numbers = "no simulation created energy";
  if (whole > 0)
    enter_words(out, true,
                format("at most %.2g %% of the energy unexplained, in %d complete runs", 100 * largest, whole));
  return out;
}

std::string_view state_of(const Diagnosis& one) {
  return one.is_doubtful() ? "doubtful" : one.unknown.empty() ? "fine" : "unknown";
}

std::vector<std::string> found_in(const Diagnosis& one) {
  std::vector<std::string> found = one.reservations;
  found.insert(found.end(), one.notes.begin(), one.notes.end());
  return found;
}

}  // namespace

std::vector<Diagnosis> diagnoses_of(const Card& card, std::span<const StoredEvaluation> evaluations) {
  return {heaps(card),      readings(card),  bounds(card),
          plausible(card),  pressure(card),  packings(card),
          validation(card), repeats(card),   measured_together(card),
          grains(card),     intervals(card), time_step(card, evaluations)};
}

std::vector<std::string> reservations_on(const Card& card) {
  std::vector<std::string> out;
  for (Diagnosis& one : diagnoses_of(card)) std::ranges::move(one.reservations, std::back_inserter(out));
  return out;
}

std::string diagnosis_lines(std::span<const Diagnosis> diagnoses) {
  std::string out;
  for (const Diagnosis& one : diagnoses) {
    out += std::string(one.name) + ": ";
    if (!one.is_doubtful()) {
      out += one.unknown.empty() ? "fine (" + one.numbers + ")\n" : "unknown (" + one.unknown + ")\n";
      continue;
    }
    out += "doubtful\n";
    for (const std::string& found : found_in(one)) out += "  " + found + ".\n";
    out += "  May be ignored " + std::string(one.may_be_ignored) + ". See " + std::string(one.page) + ".\n";
  }
  return wrapped(lines_of(out));
}

nlohmann::ordered_json diagnosis_json(std::span<const Diagnosis> diagnoses) {
  auto out = nlohmann::ordered_json::array();
  for (const Diagnosis& one : diagnoses)
    out.push_back({{"name", one.name},
                   {"state", state_of(one)},
                   {"found", found_in(one)},
                   {"numbers", one.unknown.empty() ? one.numbers : one.unknown},
                   {"may_be_ignored", one.may_be_ignored},
                   {"page", one.page}});
  return out;
}

}  // namespace pastefit
