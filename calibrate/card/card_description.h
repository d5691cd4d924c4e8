#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/object_schema.h"
#include "calibrate/base/object_writer.h"
#include "calibrate/card/card.h"
#include "calibrate/card/standing.h"
#include "calibrate/laboratory/specimen_json.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"

// JSON form of a card, described once for reader, writer and schema (`ObjectReader`, `OrderedObjectWriter`,
// `ObjectSchema`). To add a field, add a member in card.h and a line here.
namespace pastefit::card_fields {

inline constexpr Range any;
inline constexpr Range not_negative{0};
inline constexpr Range positive{0, largest_quantity, true};
inline constexpr Range share{0, 1};
inline constexpr Range grain_radius{0, 1, true};
inline constexpr int many = 1'000'000, very_many = 1'000'000'000;

/// Range of a simulated reading in the test of a card. Heaps of coarse grains exceed the measured range: a spread
/// begins at 0, and everything may be half as large again. Unlimited for unknown readings.
inline Range simulated_range(std::string_view name, const Test* test) {
  if (!test) return any;
  const auto kinds = reading_kinds(*test);
  const ReadingKind* kind = find_kind(kinds, name);
  if (!kind) return any;
  const auto [smallest, largest] = kind->possible;
  return {1.5 * std::min(smallest, 0.0), 1.5 * largest};
}

/// `packings`: of the confirmation.
template <class Fields, class Of>
void describe_reading(Fields& fields, Of& one, const Range& range, std::size_t packings) {
  fields.number({"simulated", "mean over the packings"}, one.simulated, range, required);
  fields.number({"simulated_standard_deviation", "from packing to packing"}, one.simulated_standard_deviation,
                not_negative, required);
  if constexpr (Fields::reads) one.packings = 0;  // default: all of the confirmation's
  fields.integer({"packings",
                  "that these two are of, where a laboratory would reject some of the confirmation's, e.g. heaps that "
                  "sheared off"},
                 one.packings, 1, many, WrittenIf{static_cast<std::size_t>(one.packings) != packings});
  fields.derived_number({"standard_error", "of the mean, with two packings or more; derived"}, standard_error(one),
                        not_negative);
  fields.nullable_number({"measured", "the laboratory's; null: not measured"}, one.measured, range, required);
  const With measurement{one.measured.has_value()};
  fields.number({"standard_deviation", "of one measurement"}, one.standard_deviation, not_negative, measurement);
  fields.integer({"repeats", "measurements"}, one.repeats, 0, many, measurement);
  fields.number({"weight", "in the fit; 0: not fitted"}, one.weight, not_negative, measurement);
  fields.number({"tolerance", "how far off it may be; of a reading that was measured"}, one.tolerance, positive,
                measurement);
  std::optional<double> difference;
  if (one.measured) difference = one.simulated - *one.measured;
  fields.derived_number({"difference", "simulated less measured; derived"}, difference, any);
  fields.optional_number({"band", "of a hold-out: difference that the noise of both explains"}, one.band, not_negative);
}

void describe_provenance(auto& fields, auto& lab) {
  fields.text({"source", "who measured"}, lab.source, required);
  fields.text({"licence", "under which it may be passed on"}, lab.licence, required);
  fields.text({"notes", "what else is known"}, lab.notes, required);
  fields.flag({"twin", "simulated with known parameters"}, lab.twin, required);
}

/// Runs of a baseline in the form of the file: one column for each reading.
struct BaselineColumns {
  struct Column {
    std::string name;
    std::vector<double> values;
  };
  std::vector<std::uint64_t> packings;
  std::vector<Column> readings;
};
BaselineColumns baseline_columns(const Baseline& baseline);
std::vector<Baseline::Run> baseline_runs(const BaselineColumns& columns);

template <class Fields, class Of>
void describe_baseline(Fields& fields, Of& baseline, const Test* test) {
  BaselineColumns columns = baseline_columns(baseline);
  fields.text({"program", "version and fingerprint of the engine"}, baseline.program, required);
  fields.text({"machine", "processor and C library"}, baseline.machine, required);
  fields.integers({"packings", "seeds"}, columns.packings, required);
  const std::size_t count = columns.packings.size();
  fields.entries({"readings", "one number for each packing, by reading"}, columns.readings,
                 &BaselineColumns::Column::name, required, [&](auto& readings, const Key& name, auto& column) {
                   readings.numbers(name, column.values, simulated_range(name, test), required, count, count);
                 });
  if constexpr (Fields::reads) baseline.runs = baseline_runs(columns);
}

void describe_yield_stresses(auto& fields, const Key& key, auto&& stresses) {
  named_objects(fields, key, stresses, &ComparedYieldStress::reading, Need::optional, [](auto& stress, auto& one) {
    stress.text({"formula", "its authors and year"}, one.formula, required);
    stress.number({"simulated", "by the simulated reading"}, one.simulated_pa, not_negative, required);
    stress.optional_number({"measured", "by the laboratory's reading; absent if it was not taken"}, one.reading_pa,
                           not_negative);
    stress.optional_number({"ratio", "simulated over measured_yield_stress_pa; absent without it"}, one.ratio,
                           not_negative);
    stress.optional_number({"deviations",
                            "by which simulated is above it, in its standard deviations; absent without "
                            "it"},
                           one.deviations, any);
  });
}

/// The test itself, in SI, without the parts equal to the material's; returns whether there is one.
bool describe_test(ObjectReader& fields, const Key& key, CardTest& test, const nlohmann::json* material);
bool describe_test(OrderedObjectWriter& fields, const Key& key, const CardTest& test, const Material& material);
bool describe_test(ObjectSchema& fields, const Key& key, const CardTest& test, const Material& material);

/// `material`: of the card, as `describe_test` takes it. `packings`: of the confirmation.
template <class Fields, class Of, class Whole>
void describe_card_test(Fields& fields, Of& test, const Whole& material, std::size_t packings) {
  fields.text({"name", "unique; absent if there is one test only"}, test.name, Default{std::string()});
  fields.flag({"hold_out", "predicted, not fitted"}, test.hold_out, Default{false});
  fields.text({"lab_file", "as the study names it"}, test.lab_file, required);
  fields.text({"lab_hash", "of its content (FNV-1a)"}, test.lab_hash, required);
  fields.object({"lab", "what the laboratory file says of itself"}, required,
                [&](auto& lab) { describe_provenance(lab, test.lab); });
  fields.optional_object(
      {"measured_yield_stress_pa",
       "what the laboratory measured with a vane or another rheometer; compared, not fitted; absent if it did not"},
      test.yield_stress, [](auto& measured, auto& one) {
        if constexpr (Fields::reads) one.reading = "yield_stress_pa";
        measured.number({"value", "mean of the repeats"}, one.value, positive, required);
        measured.number({"standard_deviation", "of one measurement"}, one.standard_deviation, positive, required);
        measured.integer({"repeats", "measurements that the value is a mean of"}, one.repeats, 1, many, required);
      });
  fields.derived_object(
      {"yield_stress_pa",
       "of a fluid that would read what was read, by the names of readings; derived, as `pastefit show --json` prints "
       "it; not stored, not read"},
      [] { return nlohmann::ordered_json(); },
      [](auto& schema, const Key& key) { describe_yield_stresses(schema, key, std::vector<ComparedYieldStress>()); });
  fields.derived_object(
      {"conditions", "what a fit to this test holds for; derived, not read"}, [&] { return conditions_of(test.test); },
      [](auto& schema, const Key& key) { schema.any_numbers(key, any); });
  const bool known = describe_test(
      fields,
      {"test",
       "what was simulated: apparatus, grains and contact laws, in SI; bulk density, grains and contact are the "
       "material's where they are not said"},
      test, material);
  const Test* of_ranges = known ? &test.test : nullptr;
  fields.entries({"readings",
                  "what was read, simulated and measured, by name, which carries the unit; simulated: mean over the "
                  "confirmation packings that a laboratory would accept"},
                 test.readings, &CardReading::name, required, [&](auto& readings, const Key& name, auto& one) {
                   readings.object(name, required, [&](auto& reading) {
                     describe_reading(reading, one, simulated_range(name, of_ranges), packings);
                   });
                 });
  bool within_noise = test.within_noise.value_or(false);
  fields.flag({"within_noise", "of a hold-out: every reading that counts lies within its band"}, within_noise,
              WrittenIf{test.within_noise.has_value()});
  if constexpr (Fields::reads)
    if (fields.has("within_noise")) test.within_noise = within_noise;
  fields.object({"baseline", "what one engine read off the test in each packing; checks compare with it"},
                WrittenIf{!test.baseline.runs.empty()},
                [&](auto& baseline) { describe_baseline(baseline, test.baseline, of_ranges); });
}

/// `card`: its tests determine which parameters act.
template <class Fields, class Of>
void describe_parameters(Fields& fields, Of& parameters, const Card& card) {
  fields.object({"parameters", "scale-free form of the contact laws; names as in study files"}, required,
                [&](auto& values) {
                  for (auto& one : parameters) {
                    const auto kind = std::ranges::find(parameter_kinds(), one.name, &ParameterKind::name);
                    values.number({one.name, kind->meaning}, one.value, {kind->smallest, kind->largest},
                                  WrittenIf{has_parameter(card, one.name)});
                  }
                });
  const auto describe_free = [&](auto& free) {
    for (auto& one : parameters) {
      const auto bounds = [&](auto& own) {
        own.number({"lower", "bound"}, one.lower, any, required);
        own.number({"upper", "bound"}, one.upper, any, required);
        own.choice({"scale", "on which it was searched"}, one.scale, scales, required);
        own.optional_object({"prior", "what was known beforehand"}, one.prior, [](auto& prior, auto& known) {
          prior.number({"value", "mean"}, known.value, any, required);
          prior.number({"standard_deviation", "how well it was known"}, known.standard_deviation, not_negative,
                       required);
        });
      };
      if constexpr (Fields::reads)
        one.free = free.object(one.name, Need::optional, bounds);
      else
        free.object(one.name, WrittenIf{one.free && has_parameter(card, one.name)}, bounds);
    }
  };
  const Key key("free", "the parameters that were fitted, with their bounds");
  if constexpr (requires { fields.known_entries(key, required, describe_free); })
    fields.known_entries(key, required, describe_free);
  else
    fields.object(key, required, describe_free);
}

void describe_confirmation(auto& fields, auto& confirmation) {
  fields.integers({"packings", "seeds of the packings"}, confirmation.packings, required);
  fields.flag({"fresh", "the search had not seen these packings"}, confirmation.fresh, required);
  fields.number({"error",
                 "largest difference of a fitted reading from the laboratory, over its tolerance; at most 1 "
                 "is allowed"},
                confirmation.error, not_negative, required);
  fields.flag({"meets_laboratory", "every fitted reading is within its tolerance, surely enough"},
              confirmation.meets_laboratory, required);
  fields.flag({"refuted", "true: a reading is not, or too many heaps shear off, surely enough"}, confirmation.refuted,
              Default{false});
  fields.optional_number(
      {"rejected_share", "share of heaps that a laboratory may reject for the material to meet it; 1: not judged"},
      confirmation.rejected_share, share);
}

std::vector<std::string> failure_names();

template <class Fields, class Of>
void describe_search(Fields& fields, Of& search) {
  fields.text({"strategy", "name of the search"}, search.strategy, required);
  fields.text({"status", "how it ended: confirmed, unconfirmed, out_of_reach, stopped, failed"}, search.status,
              required);
  fields.text({"reason", "the same for people"}, search.reason, required);
  fields.integer({"seed", "of the search"}, search.seed, required);
  fields.integers({"packings", "seeds of the packings on which candidates were compared"}, search.packings, required);
  fields.integer({"budget", "simulations allowed"}, search.budget, 0, very_many, required);
  fields.integer({"simulations", "simulations finished, those known from an earlier run included"}, search.simulations,
                 0, very_many, required);
  fields.object({"failures", "simulations without an answer, by reason"}, required, [&](auto& failures) {
    for (const std::string& name : failure_names()) {
      const auto known = search.failures.find(name);
      const bool counted = known != search.failures.end();
      int count = counted ? known->second : 0;
      failures.integer({name, "simulations that ended so"}, count, 0, very_many, WrittenIf{counted});
      if constexpr (Fields::reads)
        if (failures.has(name)) search.failures[name] = count;
    }
  });
  fields.integer({"coarse_simulations", "of coarse grains, beside the budget"}, search.coarse_simulations, 0, very_many,
                 Default{0});
}

void describe_conditions(auto& fields, auto& conditions) {
  named_objects(
      fields,
      {"unstated_conditions",
       "conditions of the tests that neither the laboratory nor the study states, and what they do to the readings of "
       "this material; contained in the intervals"},
      conditions, &ConditionEffect::place, WrittenIf{!conditions.empty()}, [](auto& effect, auto& one) {
        effect.number({"assumed", "value, in the unit of its key"}, one.assumed, any, required);
        effect.number({"lower", "end of the range in which it may lie"}, one.lower, any, required);
        effect.number({"upper", "end of the range in which it may lie"}, one.upper, any, required);
        effect.integer({"packings", "on which both ends were simulated and no heap was rejected"}, one.packings, 0,
                       1000, required);
        named_objects(effect, {"readings", "means over these packings"}, one.readings, &ConditionEffect::Reading::name,
                      required, [](auto& ends, auto& reading) {
                        ends.number({"at_lower", "at the lower end"}, reading.at_lower, any, required);
                        ends.number({"at_upper", "at the upper end"}, reading.at_upper, any, required);
                      });
      });
}

struct Row {
  std::string first;
  std::vector<CardInference::Correlation> pairs;
};
std::vector<Row> rows_of(const std::vector<CardInference::Correlation>& correlations);
std::vector<CardInference::Correlation> pairs_of(const std::vector<Row>& rows);

template <class Fields, class Of>
void describe_inference(Fields& fields, Of& inference) {
  fields.object({"intervals", "range of each fitted parameter that agrees with the readings"},
                WrittenIf{!inference.intervals.empty()}, [&](auto& intervals) {
                  intervals.text({"method", "in words"}, inference.method, required);
                  intervals.number({"level", "probability with which an interval holds the parameter"}, inference.level,
                                   share, required);
                  named_objects(intervals, {"parameters", "those with an end that the readings set"},
                                inference.intervals, &CardInference::Interval::parameter, required,
                                [](auto& interval, auto& one) {
                                  interval.number({"lower", "end"}, one.lower, any, required);
                                  interval.number({"upper", "end"}, one.upper, any, required);
                                });
                });
  std::vector<Row> rows = rows_of(inference.correlations);
  fields.entries({"correlation", "of pairs of parameters, within their joint interval"}, rows, &Row::first,
                 WrittenIf{!rows.empty()}, [](auto& correlation, const Key& first, auto& row) {
                   correlation.entries(first, row.pairs, &CardInference::Correlation::second, required,
                                       [](auto& pairs, const Key& second, auto& pair) {
                                         pairs.number(second, pair.value, {-1, 1}, required);
                                       });
                 });
  if constexpr (Fields::reads) inference.correlations = pairs_of(rows);
  fields.entries({"not_identified", "parameters that the readings do not identify, and why"}, inference.not_identified,
                 &CardInference::NotIdentified::parameter, WrittenIf{!inference.not_identified.empty()},
                 [](auto& unseen, const Key& name, auto& one) { unseen.text(name, one.reason, required); });
  describe_conditions(fields, inference.conditions);
}

void describe_rebaseline(auto& fields, auto& change) {
  fields.text({"why", "in words"}, change.why, required);
  fields.text({"program_before", "version and fingerprint"}, change.program_before, required);
  fields.text({"program_after", "version and fingerprint"}, change.program_after, required);
  named_objects(fields, {"moved", "means of readings that changed"}, change.moved, &Rebaseline::Moved::reading,
                required, [](auto& moved, auto& one) {
                  moved.number({"before", "mean"}, one.before, any, required);
                  moved.number({"after", "mean"}, one.after, any, required);
                });
}

void describe_rescaling(auto& fields, auto& step) {
  fields.number({"from_radius_m", "mean radius before"}, step.from_radius_m, grain_radius, required);
  named_objects(fields, {"bias", "what the step did to the readings"}, step.bias, &Rescaling::Bias::reading, required,
                [](auto& bias, auto& one) {
                  bias.number({"before", "mean"}, one.before, any, required);
                  bias.number({"after", "mean"}, one.after, any, required);
                  bias.number({"standard_error", "of their difference"}, one.standard_error, not_negative, required);
                });
}

void describe_further_confirmation(auto& fields, auto& one) {
  fields.text({"engine", "that simulated it"}, one.engine, required);
  fields.text({"program", "as it calls itself, with its version"}, one.program, required);
  fields.text({"test", "name of the test; without it the card's only one"}, one.test, Default{std::string()});
  fields.number({"radius_m", "mean radius of the grains"}, one.radius_m, grain_radius, required);
  fields.integers({"packings", "seeds"}, one.packings, required);
  fields.integer({"accepted", "packings whose heap a laboratory would accept; all, if it would accept none"},
                 one.accepted, 1, many, required);
  fields.integer({"ranks", "processes that shared a simulation"}, one.ranks, 1, many, required);
  fields.number({"wall_s", "wall time of the time steps of all packings"}, one.wall_s, not_negative, required);
  fields.number({"core_s", "processor time of the time steps of all packings, all ranks together"}, one.core_s,
                not_negative, required);
  fields.optional_number({"error", "largest difference of a fitted reading over its tolerance"}, one.error,
                         not_negative);
  fields.flag({"meets_laboratory", "there, and the noise of the packings leaves no doubt"}, one.meets_laboratory,
              required);
  named_objects(fields, {"readings", "those that the card has, too"}, one.readings, &FurtherConfirmation::Reading::name,
                required, [](auto& reading, auto& own) {
                  reading.number({"card", "mean of the card's own confirmation"}, own.card, any, required);
                  reading.number({"simulated", "mean there"}, own.simulated, any, required);
                  reading.number({"simulated_standard_deviation", "there, from packing to packing"},
                                 own.simulated_standard_deviation, not_negative, required);
                  reading.derived_number({"bias", "simulated less card; derived"}, own.bias(), any);
                  reading.optional_number({"standard_error", "of the bias"}, own.standard_error, not_negative);
                });
}

void describe_interpolation(auto& fields, auto& one) {
  static constexpr std::array<Named<std::string_view>, 2> models{
      {{"linear", "linear"}, {"gaussian_process", "gaussian_process"}}};
  fields.text({"variable", "of the laboratory files, with its place there"}, one.variable, required);
  fields.number({"value", "at which, in the unit of its name"}, one.value, any, required);
  fields.choice({"model", "of each parameter over the variable"}, one.model, models, required);
  fields.texts({"studies", "names of those whose materials it lies between"}, one.studies, required);
}

template <class Fields, class Of>
void describe_card(Fields& fields, Of& card) {
  fields.text({"title", "title, one line"}, card.title, required);
  fields.object({"material", "its contact laws, in SI for grains of one size, and scale-free"}, required,
                [&](auto& material) {
                  describe_material(material, card.material);
                  material.nullable_number({"grain_density_kg_m3",
                                            "of the grains, such that they fill a vessel with the bulk density; null: "
                                            "not known"},
                                           card.material.grain_density_kg_m3, not_negative, required);
                  describe_parameters(material, card.material.parameters, card);
                });
  fields.list({"tests", "what the material was fitted to and what it predicts, on the same packings"}, card.tests,
              Need::required, [&](auto& entry, auto& test) {
                const std::size_t packings = card.confirmation.packings.size();
                if constexpr (Fields::reads)
                  describe_card_test(entry, test, fields.content("material"), packings);
                else
                  describe_card_test(entry, test, card.material, packings);
              });
  fields.object({"confirmation", "how the material was judged"}, required,
                [&](auto& confirmation) { describe_confirmation(confirmation, card.confirmation); });
  fields.object({"search", "how the material was found"}, required,
                [&](auto& search) { describe_search(search, card.search); });
  fields.object({"provenance", "from what, by what"}, required, [&](auto& provenance) {
    provenance.text({"study_file", "as it was named"}, card.provenance.study_file, required);
    provenance.text({"study_hash", "of its content (FNV-1a)"}, card.provenance.study_hash, required);
    provenance.text({"program", "version and fingerprint of the engine"}, card.provenance.program, required);
    provenance.texts({"settings", "changes of the study file for this calibration, PATH=VALUE; absent: none"},
                     card.provenance.settings, Need::optional);
  });
  describe_inference(fields, card.inference);
  fields.list({"rebaselined", "changes of the baseline that were meant, oldest first"}, card.rebaselined,
              Need::optional, [](auto& entry, auto& change) { describe_rebaseline(entry, change); });
  fields.list({"rescaled", "steps to other grain sizes, oldest first, with what they did to the readings"},
              card.rescaled, Need::optional, [](auto& entry, auto& step) { describe_rescaling(entry, step); });
  fields.list({"further_confirmations",
               "a test of the card in another engine, maybe with grains of another size, oldest first"},
              card.further_confirmations, Need::optional,
              [](auto& entry, auto& one) { describe_further_confirmation(entry, one); });
  fields.optional_object({"interpolated",
                          "absent of a material that was fitted; one with it was interpolated between fitted ones, "
                          "and no reading of it was met"},
                         card.interpolated, [](auto& inner, auto& one) { describe_interpolation(inner, one); });
}

}  // namespace pastefit::card_fields
