#include "calibrate/study/lab.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/schemas.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

/// Asks about sizes far outside the usual range, which are mostly in another unit.
void ask_about_sizes(const Test& test, Questions& questions) {
  const auto sizes = std::visit([](const auto& one) { return experience_of(one); }, test);
  for (const auto& [place, value, smallest, largest] : sizes) {
    if (value >= smallest && value <= largest) continue;
    const Unit unit = unit_of_place(place).value();
    const std::string own = " " + std::string(unit.name), others = in_other_units(value, unit.key, smallest, largest);
    questions.ask(std::string(place),
                  "is " + shown(value) + own + ", far from the " + shown(smallest) + " to " + shown(largest) + own +
                      " of such tests",
                  others.empty() ? "check it for a typing error" : "look at its unit (" + others + ")");
  }
}

/// Marks numbers that the file does not give as defaults, or as values of the preset.
Faults with_defaults_named(Faults faults, const nlohmann::json& document, bool preset) {
  for (Fault& fault : faults) {
    const bool key = fault.where.starts_with("apparatus.") || fault.where.starts_with("grains.");
    if (!key || document.contains(pointer_to(fault.where))) continue;
    fault.what += preset ? " (from the preset)" : " (the default)";
    fault.remedy += "; add the key";
  }
  return faults;
}

/// Notes on conditions that affect a reading and are taken from the preset.
std::vector<std::string> notes_on_conditions(const Lab& lab) {
  std::vector<std::string> notes;
  const auto kinds = reading_kinds(lab.test);
  for (const Measurement& one : lab.measurements) {
    const ReadingKind* kind = find_kind(kinds, one.reading);
    if (!kind || kind->depends_on.empty() || std::ranges::count(lab.stated, kind->depends_on) > 0) continue;
    notes.push_back(one.reading + " depends on " + std::string(kind->depends_on) +
                    ", which the file does not state; the preset's is assumed");
  }
  return notes;
}

/// Note on the readings that the formulas predict from the measured yield stress.
std::string note_on_yield_stress(const Lab& lab) {
  const auto predicted = readings_of_fluid(lab.test, lab.yield_stress->value);
  std::string readings;
  for (const PredictedReading& one : predicted.value_or(std::vector<PredictedReading>{}))
    readings += (readings.empty() ? "" : ", ") + std::string(one.key) + " " + shown(rounded(one.value, 3)) + " +- " +
                shown(rounded(one.standard_deviation, 2)) + " (" + std::string(one.formula) + ")";
  return "the yield stress of " + shown(lab.yield_stress->value) + " Pa is compared, not fitted; " +
         (readings.empty() ? "no formula predicts a reading from it" : "a fluid with it would have " + readings);
}

void describe_repeats(auto& fields, Lab::Repeats& repeats) {
  fields.integer({"made", "number of heaps, including those that sheared off"}, repeats.made, 1, 1000, Need::required);
  fields.integer({"sheared", "number of heaps that sheared off and have no readings; less than made"}, repeats.sheared,
                 0, 1000, Need::required);
}

/// Reads "repeats": number of heaps, and number of sheared-off heaps.
void read_repeats(ObjectReader& document, const Lab& lab, Lab::Repeats& repeats) {
  if (!rejection_index(lab.test, {})) {
    document.refuse("repeats", "a " + std::string(kind_of(lab.test)) + " test has no heap that shears off",
                    "leave it out");
    return;
  }
  document.object("repeats", Need::optional, [&](ObjectReader& reader) {
    const std::size_t before = reader.faults().size();
    describe_repeats(reader, repeats);
    if (reader.faults().size() > before) return;
    if (repeats.sheared > repeats.made)
      reader.fault("sheared",
                   std::to_string(repeats.sheared) + " of " + std::to_string(repeats.made) + " repeats sheared off",
                   "at most as many as were made, those that sheared off included");
    else if (repeats.sheared == repeats.made)
      reader.fault("sheared", "all repeats sheared off, so there is no height to report",
                   "use a smaller apparatus or a flow test: this test does not suit the material");
  });
  const int stood = repeats.made - repeats.sheared;
  for (const Measurement& one : lab.measurements)
    if (stood > 0 && one.repeats > stood)
      document.fault(
          "measurements." + one.reading,
          "has " + std::to_string(one.repeats) + " repeats, but only " + std::to_string(stood) + " heaps stood",
          "leave out the readings of heaps that sheared off, or count them in \"repeats\"");
}

/// True if every value could be read: the faults from index `first` on are unknown keys only.
bool values_are_good(const Faults& faults, std::size_t first) {
  return std::all_of(faults.begin() + static_cast<std::ptrdiff_t>(first), faults.end(),
                     [](const Fault& fault) { return fault.what == unknown_key; });
}

/// Note on a preset beside the file that names it: "the preset abrams is /mine/apparatus/abrams.json, not the shipped
/// one"; empty for a shipped preset.
std::string note_on_preset(const Apparatus& preset) {
  std::vector<std::filesystem::path> shipped = apparatus_folders({});
  shipped.erase(shipped.begin());
  const auto is_here = [&](const std::filesystem::path& folder) {
    std::error_code error;
    return std::filesystem::equivalent(folder, preset.file.parent_path(), error);
  };
  if (std::ranges::any_of(shipped, is_here)) return {};
  return "the preset " + one_line(preset.file.stem().string()) + " is " + one_line(preset.file.string()) +
         ", not the shipped one";
}

/// The preset's caution; empty if the test has readings that the preset's own apparatus does not have.
std::string caution_of(const Apparatus& preset, const Test& test) {
  const auto taken_by = [](const Test& one) {
    return std::ranges::count_if(reading_kinds(one), [](const ReadingKind& kind) { return !kind.lack; });
  };
  return taken_by(test) > taken_by(preset.test) ? "" : preset.caution;
}

/// Reads "mix": numbers under names chosen by the user.
void read_mix(ObjectReader& document, std::vector<MixVariable>& mix) {
  if (!document.has("mix")) return document.known("mix");
  document.object(
      "mix", Need::optional,
      [&](ObjectReader& reader) {
        for (const std::string& name : reader.keys()) {
          double value = 0;
          if (!reader.number(name, value, {}, Need::required)) continue;
          const bool word = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
          if (word && !name.empty() && name[0] >= 'a')
            mix.push_back({name, value});
          else
            reader.fault(name, "is not a name of a mix variable",
                         "small letters, digits and _, with the unit at its end: \"water_kg_m3\"");
        }
      },
      "names with their units and numbers: {\"water_kg_m3\": 180}");
}

}  // namespace

std::string sheared_in_words(const Lab::Repeats& repeats) {
  return std::to_string(repeats.sheared) + " of " + std::to_string(repeats.made) +
         " heaps of the laboratory sheared off";
}

Result<Lab> lab_from_json(const nlohmann::json& document, const std::filesystem::path& folder) {
  Lab lab;
  std::optional<Apparatus> preset;
  const Faults found = read_document(document, "pastefit-lab-1", [&](ObjectReader& reader) {
    Faults& faults = reader.faults();
    reader.text("title", lab.title, Need::required);
    read_provenance(reader, lab.provenance);
    std::vector<std::string> assumed;
    reader.texts("assumed", assumed, Need::optional);
    Questions questions(reader);
    const std::size_t before = faults.size();
    read_kind(reader, lab.test);
    preset = read_apparatus(reader, lab.test, folder);
    read_material(reader, lab.test,
                  [&](ObjectReader& material) { lab.yield_stress = read_yield_stress(material, lab.test, questions); });
    read_mix(reader, lab.mix);
    read_grains(reader, lab.test, preset ? Need::optional : Need::required);
    lab.test = with_default_contact(lab.test);
    // After a fault in a section, the checks would only report defaults.
    const auto judge_test = [&] {
      if (values_are_good(faults, before))
        append(faults, with_defaults_named(validate_in_file_words(lab.test), document, preset.has_value()));
    };
    judge_test();
    if (values_are_good(faults, before)) ask_about_sizes(lab.test, questions);
    lab.measurements = read_measurements(reader, lab.test, lab.yield_stress, questions);
    judge_test();  // a reading enables its measurement, whose defaults may not suit the apparatus
    read_repeats(reader, lab, lab.repeats);
    for (const FilePlace& one : places_in_files(lab.test))
      if (one.often_unstated && document.contains(pointer_to(one.place)) && std::ranges::count(assumed, one.place) == 0)
        lab.stated.push_back(one.place);
    if (values_are_good(faults, before)) append(faults, check_readings(lab.test, lab.measurements).faults);
    lab.notes = questions.notes();
    for (std::string& note : notes_on_conditions(lab)) lab.notes.push_back(std::move(note));
    if (lab.yield_stress && faults.empty()) lab.notes.push_back(note_on_yield_stress(lab));
    if (lab.repeats.sheared > 0) lab.notes.push_back(sheared_in_words(lab.repeats));
  });
  if (!found.empty()) return found;
  if (preset) lab.note = note_on_preset(*preset);
  if (preset)
    if (std::string caution = caution_of(*preset, lab.test); !caution.empty()) lab.notes.push_back(std::move(caution));
  if (std::string few = note_on_grain_count(lab.test); !few.empty()) lab.notes.push_back(std::move(few));
  const std::string apparatus = preset ? preset->content : "";
  lab.content = nlohmann::json{{"laboratory", document}, {"preset", apparatus}}.dump();
  lab.hash = content_hash(document.dump() + apparatus);
  return lab;
}

Result<Lab> read_lab(const std::filesystem::path& file, const std::function<void(nlohmann::json&)>& change) {
  return read_file(file, [&](nlohmann::json& document) {
    if (change) change(document);
    return lab_from_json(document, file.parent_path());
  });
}

ObjectSchema::Json lab_schema() {
  using Json = ObjectSchema::Json;
  ObjectSchema schema("pastefit-lab-1");
  schema.text({"title", "title, one line"}, "", Need::required);
  schema.texts({"confirmed",
                "keys of unusual values that are correct, e.g. [\"material.bulk_density_kg_m3\"]; the messages of the "
                "program name these keys"},
               {}, Need::optional);
  schema.texts({"assumed", "keys of values that are assumed, not measured, e.g. [\"apparatus.lift_velocity_mm_s\"]"},
               {}, Need::optional);
  tell_provenance(schema);
  tell_test(schema, true);
  schema.object({"material", "the fresh material"}, Need::required, [](ObjectSchema& material) {
    tell_density(material);
    tell_yield_stress(material);
  });
  Json mix{{"type", "object"}};
  mix["propertyNames"]["pattern"] = "^[a-z][a-z0-9_]*$";
  mix["additionalProperties"] = {{"type", "number"}, {"minimum", -largest_quantity}, {"maximum", largest_quantity}};
  schema.put({"mix",
              "amounts and properties of the mix, each under a name that ends with its unit, e.g. water_kg_m3; not "
              "simulated, but shown in tables of several studies"},
             std::move(mix), Need::optional);
  tell_grains(schema, Need::optional);
  Lab::Repeats any;
  schema.object({"repeats",
                 "for tests with a heap: numbers of heaps made and sheared off; a study without `rejected_share` "
                 "accepts at least this share of sheared-off heaps"},
                Need::optional, [&](ObjectSchema& fields) { describe_repeats(fields, any); });
  tell_measurements(schema);
  schema.described()["if"]["not"]["properties"]["apparatus"]["required"].push_back("preset");
  schema.described()["then"]["required"].push_back("grains");
  return schema.document("pastefit laboratory file",
                         "Measurements of one laboratory test. The schema does not contain limits that depend on the "
                         "apparatus, e.g. that no heap is higher than its vessel. The program checks these limits.");
}

}  // namespace pastefit
