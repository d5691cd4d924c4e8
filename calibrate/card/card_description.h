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
  fields.number({"simulated", "mean of the simulated reading over the packings"}, one.simulated.mean, range, required);
  fields.number({"simulated_standard_deviation", "standard deviation between packings"},
                one.simulated.standard_deviation, not_negative, required);
  if constexpr (Fields::reads) one.simulated.count = 0;  // default: all of the confirmation's
  fields.integer({"packings",
                  "number of packings in this mean and standard deviation; present only if a laboratory would reject "
                  "some packings of the confirmation, e.g. because their heaps sheared off"},
                 one.simulated.count, 1, many, WrittenIf{static_cast<std::size_t>(one.simulated.count) != packings});
  std::optional<double> error = standard_error(one), difference;
  fields.optional_number({"standard_error", "standard error of the mean of two or more packings; derived"}, error,
                         not_negative);
  fields.nullable_number({"measured", "measured reading; null: not measured"}, one.measured, range, required);
  const With measurement{one.measured.has_value()};
  fields.number({"standard_deviation", "standard deviation of one measurement"}, one.standard_deviation, not_negative,
                measurement);
  fields.integer({"repeats", "number of measurements"}, one.repeats, 0, many, measurement);
  fields.number({"weight", "weight of the reading in the fit; 0: not fitted"}, one.weight, not_negative, measurement);
  fields.number({"tolerance", "largest accepted difference from the measured reading, if there is one"}, one.tolerance,
                positive, measurement);
  if (one.measured) difference = one.simulated.mean - *one.measured;
  fields.optional_number({"difference", "simulated minus measured reading; derived"}, difference, any);
  fields.optional_number({"band", "in hold-out tests: largest difference that noise explains"}, one.band, not_negative);
}

void describe_provenance(auto& fields, auto& lab) {
  fields.text({"source", "who measured, or the publication"}, lab.source, required);
  fields.text({"licence", "licence of the data"}, lab.licence, required);
  fields.text({"notes", "other information"}, lab.notes, required);
  fields.flag({"twin", "true: the readings are simulated with known parameters, not measured"}, lab.twin, required);
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
  fields.integers({"packings", "seeds of the packings"}, columns.packings, required);
  const std::size_t count = columns.packings.size();
  fields.entries({"readings", "by the name of the reading: one value for each packing"}, columns.readings,
                 &BaselineColumns::Column::name, required, [&](auto& readings, const Key& name, auto& column) {
                   readings.numbers(name, column.values, simulated_range(name, test), required, count, count);
                 });
  if constexpr (Fields::reads) baseline.runs = baseline_runs(columns);
}

void describe_yield_stresses(auto& fields, const Key& key, auto&& stresses) {
  named_objects(fields, key, stresses, &ComparedYieldStress::reading, Need::optional, [](auto& stress, auto& one) {
    stress.text({"formula", "authors and year of the formula"}, one.formula, required);
    stress.number({"simulated", "yield stress from the simulated reading"}, one.simulated_pa, not_negative, required);
    stress.optional_number({"measured", "yield stress from the measured reading, if there is one"}, one.reading_pa,
                           not_negative);
    stress.optional_number({"ratio", "simulated yield stress divided by measured_yield_stress_pa, if there is one"},
                           one.ratio, not_negative);
    stress.optional_number({"deviations",
                            "simulated yield stress minus measured_yield_stress_pa, if there is one, in standard "
                            "deviations of one measurement"},
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
  fields.text({"name", "unique name of the test; absent if it is the only one"}, test.name, Default{std::string()});
  fields.flag({"hold_out", "true: the test was predicted, not fitted"}, test.hold_out, Default{false});
  fields.text({"lab_file", "laboratory file, as named in the study"}, test.lab_file, required);
  fields.text({"lab_hash", "hash of the content of the laboratory file (FNV-1a)"}, test.lab_hash, required);
  fields.object({"lab", "provenance of the measurements, from the laboratory file"}, required,
                [&](auto& lab) { describe_provenance(lab, test.lab); });
  fields.optional_object(
      {"measured_yield_stress_pa",
       "yield stress measured with a vane or another rheometer; compared, not fitted; absent if it was not measured"},
      test.yield_stress, [](auto& measured, auto& one) {
        if constexpr (Fields::reads) one.reading = "yield_stress_pa";
        measured.number({"value", "mean of the repeats"}, one.value, positive, required);
        measured.number({"standard_deviation", "standard deviation of one measurement"}, one.standard_deviation,
                        positive, required);
        measured.integer({"repeats", "number of measurements in the mean"}, one.repeats, 1, many, required);
      });
  fields.derived_object(
      {"yield_stress_pa",
       "yield stress of a fluid with the same reading, by the name of the reading; `pastefit show --json` calculates "
       "and prints it; card files do not contain it, and the program ignores it on reading"},
      [] { return nlohmann::ordered_json(); },
      [](auto& schema, const Key& key) { describe_yield_stresses(schema, key, std::vector<ComparedYieldStress>()); });
  fields.derived_object(
      {"conditions", "conditions for which a fit to this test is valid; derived from the test, ignored on reading"},
      [&] { return conditions_of(test.test); }, [](auto& schema, const Key& key) { schema.any_numbers(key, any); });
  const bool known = describe_test(fields,
                                   {"test",
                                    "the simulated test in SI units: apparatus, grains and contact laws; if bulk "
                                    "density, grains or contact are absent, they are equal to those of the material"},
                                   test, material);
  const Test* of_ranges = known ? &test.test : nullptr;
  fields.entries({"readings",
                  "simulated and measured readings, by their names, which end with the unit; a simulated reading is "
                  "the mean over the confirmation packings whose heap a laboratory would accept"},
                 test.readings, &CardReading::name, required, [&](auto& readings, const Key& name, auto& one) {
                   readings.object(name, required, [&](auto& reading) {
                     describe_reading(reading, one, simulated_range(name, of_ranges), packings);
                   });
                 });
  bool within_noise = test.within_noise.value_or(false);
  fields.flag({"within_noise", "in hold-out tests: true if every weighted reading is within its band"}, within_noise,
              WrittenIf{test.within_noise.has_value()});
  if constexpr (Fields::reads)
    if (fields.has("within_noise")) test.within_noise = within_noise;
  fields.object({"baseline", "readings of one engine in each packing, with which `pastefit check` compares"},
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
        own.number({"lower", "lower bound"}, one.lower, any, required);
        own.number({"upper", "upper bound"}, one.upper, any, required);
        own.choice({"scale", "scale on which the parameter was searched"}, one.scale, scales, required);
        own.optional_object({"prior", "prior distribution, from the study"}, one.prior, [](auto& prior, auto& known) {
          prior.number({"value", "mean of the prior"}, known.value, any, required);
          prior.number({"standard_deviation", "standard deviation of the prior"}, known.standard_deviation,
                       not_negative, required);
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
  fields.flag({"fresh", "true: the search did not use these packings"}, confirmation.fresh, required);
  fields.number({"error",
                 "largest difference between simulated and measured value of a fitted reading, divided by its "
                 "tolerance; at most 1 is accepted"},
                confirmation.error, not_negative, required);
  fields.flag({"meets_laboratory",
               "true: the material is confirmed; with noise included, every fitted reading is within its tolerance, "
               "and few enough heaps shear off"},
              confirmation.meets_laboratory, required);
  fields.flag({"refuted",
               "true: the material is rejected; a fitted reading is outside its tolerance by more than the noise "
               "explains, or too many heaps shear off"},
              confirmation.refuted, Default{false});
  fields.optional_number(
      {"rejected_share", "largest accepted share of heaps that a laboratory would reject; 1: the share is not judged"},
      confirmation.rejected_share, share);
}

std::vector<std::string> failure_names();

template <class Fields, class Of>
void describe_search(Fields& fields, Of& search) {
  fields.text({"strategy", "name of the search strategy"}, search.strategy, required);
  fields.text({"status", "how the search ended: confirmed, unconfirmed, out_of_reach, stopped, failed"}, search.status,
              required);
  fields.text({"reason", "explanation of the status in words"}, search.reason, required);
  fields.integer({"seed", "seed of the search"}, search.seed, required);
  fields.integers({"packings", "seeds of the packings on which candidates were compared"}, search.packings, required);
  fields.integer({"budget", "largest number of simulations, from the study"}, search.budget, 0, very_many, required);
  fields.integer({"simulations", "number of finished simulations, including those known from an earlier run"},
                 search.simulations, 0, very_many, required);
  fields.object({"failures", "numbers of failed simulations, by reason"}, required, [&](auto& failures) {
    for (const std::string& name : failure_names()) {
      const auto known = search.failures.find(name);
      const bool counted = known != search.failures.end();
      int count = counted ? known->second : 0;
      failures.integer({name, "number of simulations that failed for this reason"}, count, 0, very_many,
                       WrittenIf{counted});
      if constexpr (Fields::reads)
        if (failures.has(name)) search.failures[name] = count;
    }
  });
  fields.integer({"coarse_simulations", "number of simulations with coarse grains, which the budget does not include"},
                 search.coarse_simulations, 0, very_many, Default{0});
}

void describe_conditions(auto& fields, auto& conditions) {
  named_objects(
      fields,
      {"unstated_conditions",
       "test conditions that neither laboratory file nor study states, with their effect on the readings of this "
       "material; the intervals include this effect"},
      conditions, &ConditionEffect::place, WrittenIf{!conditions.empty()}, [](auto& effect, auto& one) {
        effect.number({"assumed", "assumed value, in the unit of its key"}, one.assumed, any, required);
        effect.number({"lower", "lower end of the range in which the condition may lie"}, one.lower, any, required);
        effect.number({"upper", "upper end of the range in which the condition may lie"}, one.upper, any, required);
        effect.integer({"packings", "number of packings in which both ends were simulated and no heap was rejected"},
                       one.packings, 0, 1000, required);
        named_objects(effect, {"readings", "means of the readings over these packings"}, one.readings,
                      &ConditionEffect::Reading::name, required, [](auto& ends, auto& reading) {
                        ends.number({"at_lower", "mean at the lower end"}, reading.at_lower, any, required);
                        ends.number({"at_upper", "mean at the upper end"}, reading.at_upper, any, required);
                      });
      });
}

void describe_inference(auto& fields, auto& inference) {
  fields.object(
      {"intervals", "ranges of the fitted parameters that agree with the readings"},
      WrittenIf{!inference.intervals.empty()}, [&](auto& intervals) {
        intervals.text({"method", "method by which the intervals were calculated, in words"}, inference.method,
                       required);
        intervals.number({"level", "probability that an interval contains the parameter"}, inference.level, share,
                         required);
        named_objects(
            intervals,
            {"parameters",
             "intervals by the name of the parameter; only those with at least one end that the readings set"},
            inference.intervals, &CardInference::Interval::parameter, required, [](auto& interval, auto& one) {
              interval.number({"lower", "lower end"}, one.lower, any, required);
              interval.number({"upper", "upper end"}, one.upper, any, required);
            });
      });
  using Correlations = CardInference::Correlations;
  fields.entries({"correlation", "correlations of pairs of parameters, within their joint interval"},
                 inference.correlations, &Correlations::first, WrittenIf{!inference.correlations.empty()},
                 [](auto& correlation, const Key& first, auto& row) {
                   correlation.entries(first, row.others, &Correlations::With::second, required,
                                       [](auto& pairs, const Key& second, auto& pair) {
                                         pairs.number(second, pair.value, {-1, 1}, required);
                                       });
                 });
  fields.entries({"not_identified", "parameters that the readings do not identify, and why"}, inference.not_identified,
                 &CardInference::NotIdentified::parameter, WrittenIf{!inference.not_identified.empty()},
                 [](auto& unseen, const Key& name, auto& one) { unseen.text(name, one.reason, required); });
  describe_conditions(fields, inference.conditions);
}

void describe_rebaseline(auto& fields, auto& change) {
  fields.text({"why", "reason for the change, in words"}, change.why, required);
  fields.text({"program_before", "version and fingerprint of the engine before the change"}, change.program_before,
              required);
  fields.text({"program_after", "version and fingerprint of the engine after the change"}, change.program_after,
              required);
  named_objects(fields, {"moved", "readings whose mean changed"}, change.moved, &Rebaseline::Moved::reading, required,
                [](auto& moved, auto& one) {
                  moved.number({"before", "mean before the change"}, one.before, any, required);
                  moved.number({"after", "mean after the change"}, one.after, any, required);
                });
}

void describe_rescaling(auto& fields, auto& step) {
  fields.number({"from_radius_m", "mean grain radius before the change"}, step.from_radius_m, grain_radius, required);
  named_objects(fields, {"bias", "effect of the change on the readings"}, step.bias, &Rescaling::Bias::reading,
                required, [](auto& bias, auto& one) {
                  bias.number({"before", "mean before the change"}, one.before, any, required);
                  bias.number({"after", "mean after the change"}, one.after, any, required);
                  bias.number({"standard_error", "standard error of the difference between both means"},
                              one.standard_error, not_negative, required);
                });
}

void describe_further_confirmation(auto& fields, auto& one) {
  fields.text({"engine", "engine that simulated the test"}, one.engine, required);
  fields.text({"program", "name of the engine as it prints it, with its version"}, one.program, required);
  fields.text({"test", "name of the test; absent if the card has only one test"}, one.test, Default{std::string()});
  fields.number({"radius_m", "mean radius of the grains"}, one.radius_m, grain_radius, required);
  fields.integers({"packings", "seeds of the packings"}, one.packings, required);
  fields.integer(
      {"accepted",
       "number of packings whose heap a laboratory would accept; if it would accept none, the number of all packings"},
      one.accepted, 1, many, required);
  fields.integer({"ranks", "number of processes that shared a simulation"}, one.ranks, 1, many, required);
  fields.number({"wall_s", "wall time of the time steps of all packings"}, one.wall_s, not_negative, required);
  fields.number({"core_s", "processor time of the time steps of all packings, all ranks together"}, one.core_s,
                not_negative, required);
  fields.optional_number(
      {"error",
       "largest difference between simulated and measured value of a fitted reading, divided by its tolerance"},
      one.error, not_negative);
  fields.flag({"meets_laboratory",
               "true: the material is also confirmed with this engine, with the noise of the packings included"},
              one.meets_laboratory, required);
  named_objects(
      fields, {"readings", "readings that the card also contains"}, one.readings, &FurtherConfirmation::Reading::name,
      required, [](auto& reading, auto& own) {
        reading.number({"card", "mean in the card's own confirmation"}, own.card, any, required);
        reading.number({"simulated", "mean in this engine"}, own.simulated, any, required);
        reading.number({"simulated_standard_deviation", "standard deviation between packings in this engine"},
                       own.simulated_standard_deviation, not_negative, required);
        std::optional bias = own.bias();
        reading.optional_number({"bias", "mean in this engine minus mean in the card; derived"}, bias, any);
        reading.optional_number({"standard_error", "standard error of the bias"}, own.standard_error, not_negative);
      });
}

void describe_interpolation(auto& fields, auto& one) {
  static constexpr std::array<Named<std::string_view>, 2> models{
      {{"linear", "linear"}, {"gaussian_process", "gaussian_process"}}};
  fields.text({"variable", "variable of the interpolation, as a path in the laboratory files"}, one.variable, required);
  fields.number({"value", "value of the variable for this material, in the unit of its name"}, one.value, any,
                required);
  fields.choice({"model", "model of each parameter as a function of the variable"}, one.model, models, required);
  fields.texts({"studies", "names of the studies between whose materials this material lies"}, one.studies, required);
}

template <class Fields, class Of>
void describe_card(Fields& fields, Of& card) {
  fields.text({"title", "title, one line"}, card.title, required);
  fields.object(
      {"material", "the material: its contact laws in SI units, for the given grain sizes, and in scale-free form"},
      required, [&](auto& material) {
        describe_material(material, card.material);
        material.nullable_number(
            {"grain_density_kg_m3",
             "density of a grain, such that a filled vessel has the bulk density; null: not known"},
            card.material.grain_density_kg_m3, not_negative, required);
        describe_parameters(material, card.material.parameters, card);
      });
  fields.list({"tests", "fitted tests and predicted tests of the material, all simulated with the same packings"},
              card.tests, Need::required, [&](auto& entry, auto& test) {
                const std::size_t packings = card.confirmation.packings.size();
                if constexpr (Fields::reads)
                  describe_card_test(entry, test, fields.content("material"), packings);
                else
                  describe_card_test(entry, test, card.material, packings);
              });
  fields.object({"confirmation", "result of the confirmation of the material"}, required,
                [&](auto& confirmation) { describe_confirmation(confirmation, card.confirmation); });
  fields.object({"search", "the search that found the material"}, required,
                [&](auto& search) { describe_search(search, card.search); });
  fields.object({"provenance", "the study and the program that the card comes from"}, required, [&](auto& provenance) {
    provenance.text({"study_file", "name of the study file, as given to the program"}, card.provenance.study_file,
                    required);
    provenance.text({"study_hash", "hash of the content of the study (FNV-1a)"}, card.provenance.study_hash, required);
    provenance.text({"program", "version and fingerprint of the engine"}, card.provenance.program, required);
    provenance.texts({"settings", "changes of the study for this calibration, each as PATH=VALUE; absent: no changes"},
                     card.provenance.settings, Need::optional);
  });
  describe_inference(fields, card.inference);
  fields.list({"rebaselined", "intended changes of the baseline, oldest first"}, card.rebaselined, Need::optional,
              [](auto& entry, auto& change) { describe_rebaseline(entry, change); });
  fields.list({"rescaled", "changes of the grain size, oldest first, with their effect on the readings"}, card.rescaled,
              Need::optional, [](auto& entry, auto& step) { describe_rescaling(entry, step); });
  fields.list({"further_confirmations",
               "simulations of tests of the card in other engines, possibly with other grain sizes, oldest first"},
              card.further_confirmations, Need::optional,
              [](auto& entry, auto& one) { describe_further_confirmation(entry, one); });
  fields.optional_object({"interpolated",
                          "present only if the material was interpolated between fitted materials; such a material was "
                          "not fitted to readings of its own"},
                         card.interpolated, [](auto& inner, auto& one) { describe_interpolation(inner, one); });
}

}  // namespace pastefit::card_fields
