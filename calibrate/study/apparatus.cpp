#include "calibrate/study/apparatus.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <system_error>
#include <utility>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/input_file.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/schemas.h"

namespace pastefit {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr Range grain_length{0, 500, true}, bulk_density{100, 10000}, customary_deviation{1e-6, 10000};

/// Length that defines the radii of some size distributions.
struct GrainLength {
  std::string_view key, meaning;
  double GrainSizes::*value;
  bool of_mono, of_uniform, of_normal;
  bool belongs_to(SizeDistribution distribution) const {
    if (distribution == SizeDistribution::mono) return of_mono;
    return distribution == SizeDistribution::uniform ? of_uniform : of_normal;
  }
};
constexpr std::array<GrainLength, 4> grain_lengths{
    {{"radius_mm", "radius of every grain, or mean radius", &GrainSizes::radius_m, true, false, true},
     {"standard_deviation_mm", "standard deviation of the radius, before truncation", &GrainSizes::standard_deviation_m,
      false, false, true},
     {"smallest_mm", "smallest radius", &GrainSizes::smallest_m, false, true, true},
     {"largest_mm", "largest radius", &GrainSizes::largest_m, false, true, true}}};

void describe_file_provenance(auto& document, Provenance& provenance) {
  document.object({"provenance", "source of the data"}, Need::required, [&](auto& fields) {
    fields.text({"source", "who measured, where and when; or the publication"}, provenance.source, Need::required);
    fields.text({"licence", "licence of the data"}, provenance.licence, Need::optional);
    fields.text({"notes", "other information, e.g. what was assumed"}, provenance.notes, Need::optional);
    fields.flag({"twin", "true: the readings are simulated with known parameters, not measured"}, provenance.twin,
                Need::optional);
  });
}

void describe_density(auto& material, Specimen& specimen) {
  material.number({"bulk_density_kg_m3",
                   "mass divided by volume of the filled vessel, voids included; in drop, pellet and shear tests: "
                   "density of a grain"},
                  specimen.bulk_density_kg_m3, bulk_density, Need::required);
}

void describe_customary(auto& reading, Measurement& one, const Range& range) {
  reading.shared("reading");
  reading.number({"value", "usual value, in the unit of the reading's key"}, one.value, range, Need::required);
  reading.number({"standard_deviation", "standard deviation of one reading, in the same unit"}, one.standard_deviation,
                 customary_deviation, Need::required);
}

constexpr std::array not_simulated{"readings", "caution", "standards"};  // keys of apparatus files

/// Preset files by name; the first of each name.
std::map<std::string, fs::path> preset_files(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  for (const fs::path& candidate : apparatus_folders(folder)) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(candidate, error))
      if (entry.path().extension() == ".json")
        files.emplace(entry.path().stem().string(), entry.path().lexically_normal());
  }
  return files;
}

/// Reads "readings", whose keys are those of laboratory files.
void read_customary(ObjectReader& document, Apparatus& apparatus) {
  document.object("readings", Need::optional, [&](ObjectReader& readings) {
    for (const ReadingKind& kind : reading_kinds(apparatus.test)) {
      if (kind.key.empty() || kind.from_outline) continue;
      if (kind.lack) {
        readings.refuse(kind.key, std::string(kind.lack->what), std::string(kind.lack->remedy));
        continue;
      }
      Measurement one{std::string(kind.key)};
      const auto read = [&](ObjectReader& reading) {
        describe_customary(reading, one, {kind.possible.smallest, kind.possible.largest});
      };
      if (readings.object(kind.key, Need::optional, read)) apparatus.readings.push_back(std::move(one));
    }
  });
}

/// "EN12350-5" or "C143" for a standard's name with or without its nation and year; empty for other texts.
std::string standard_in(const std::string& name) {
  static const std::regex european(R"(\s*(?:[^\d\s]+\s+){0,2}EN\s*(\d{3,5}(?:-\d+)?)\s*(?:[:(].*|-\d{4}.*)?)",
                                   std::regex::icase);
  static const std::regex american(R"(\s*(?:ASTM\s*)?(C\s*\d{2,4})(?:/C\s*\d+M)?(?:-\d+\w*)?\s*)", std::regex::icase);
  std::smatch found;
  if (name.size() > 80) return {};
  if (std::regex_match(name, found, european)) return "EN" + found[1].str();
  if (!std::regex_match(name, found, american)) return {};
  std::string number = found[1].str();
  std::erase(number, ' ');
  number[0] = 'C';
  return number;
}

}  // namespace

std::vector<std::string> preset_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& [name, file] : preset_files(folder)) names.push_back(name);
  return names;
}

Result<Apparatus> find_preset(const std::string& name, const fs::path& folder) {
  const auto files = preset_files(folder);
  if (const auto file = files.find(name); file != files.end()) return read_apparatus_file(file->second);
  const Names known = names_of(preset_names(folder));
  const std::optional<std::string> near = nearest(name, known);
  return Fault{
      "apparatus.preset", "there is no preset " + in_quotes(name),
      (near ? "did you mean " + in_quotes(*near) + "? Presets: " : "presets: ") +
          (known.empty() ? "none found; set PASTEFIT_DATA_DIR to the data folder of pastefit" : listed(known))};
}

std::string preset_of_standard(const std::string& name, const fs::path& folder) {
  const std::string wanted = standard_in(name);
  const std::vector<std::string> presets = preset_names(folder);
  if (!wanted.empty() && std::ranges::count(presets, trimmed(name)) == 0)
    for (const std::string& preset : presets) {
      const auto found = find_preset(preset, folder);
      if (!found.ok()) continue;
      for (const std::string& own : found.value().standards)
        if (standard_in(own) == wanted) return preset;
    }
  return trimmed(name);
}

std::vector<fs::path> apparatus_folders(const fs::path& folder) {
  std::vector<fs::path> folders{folder / ".." / "apparatus"};
  for (const fs::path& data : data_folders()) folders.push_back(data / "apparatus");
  return folders;
}

void read_provenance(ObjectReader& document, Provenance& provenance) {
  describe_file_provenance(document, provenance);
  provenance.source = stated_source(provenance.source);
}

void tell_provenance(ObjectSchema& document) {
  Provenance any;
  describe_file_provenance(document, any);
}

void tell_test(ObjectSchema& document, bool presets) {
  const std::string usual = "kind of laboratory test; default \"" + std::string(kind_of(Test())) + "\"";
  document.put({"test", usual}, {{"enum", kinds_of_tests()}}, Need::optional);
  document.put({"apparatus", "dimensions and motions of the apparatus; the keys depend on the kind of test"},
               schema_of_apparatus(document, presets), Need::required);
}

void tell_density(ObjectSchema& material) {
  Specimen any;
  describe_density(material, any);
}

void tell_grains(ObjectSchema& document, Need need) {
  auto forms = ObjectSchema::Json::array();
  for (const auto& [name, distribution] : size_distributions)
    forms.push_back(document.described([&, word = name, own = distribution](ObjectSchema& form) {
      form.constant({"distribution",
                     "distribution of the radii; mono: one radius; uniform: all radii of a range are equally likely; "
                     "normal: a normal distribution, truncated at both ends"},
                    word, Need::required);
      for (const GrainLength& one : grain_lengths)
        if (one.belongs_to(own)) form.number({one.key, one.meaning}, 0, grain_length, Need::required);
    }));
  document.put({"grains", "sizes of the simulated grains, not of the real aggregate"}, {{"oneOf", forms}}, need);
}

ObjectSchema::Json apparatus_schema() {
  ObjectSchema schema("pastefit-rig-1");
  schema.text({"title", "title, one line"}, "", Need::required);
  tell_provenance(schema);
  tell_test(schema, false);
  schema.object({"material", "the fresh material"}, Need::required, tell_density);
  tell_grains(schema, Need::required);
  schema.object({"readings",
                 "readings that are customary for this apparatus, each with its usual value; `pastefit template lab` "
                 "prints them"},
                Need::optional, [](ObjectSchema& readings) {
                  Measurement any;
                  for (const ReadingKind& kind : all_reading_kinds())
                    if (!kind.key.empty() && !kind.from_outline)
                      readings.object({kind.key, meaning_of_reading(kind.key)}, Need::optional, [&](ObjectSchema& one) {
                        describe_customary(one, any, {-1e6, 1e6});
                      });
                });
  schema.texts(
      {"standards",
       "standards that define the apparatus, e.g. \"EN 12350-2\"; `pastefit new` accepts them as names of the preset"},
      {}, Need::optional);
  schema.text(
      {"caution",
       "warning for all users of the apparatus, one sentence without a full stop; runs with this preset print it"},
      "", Need::optional);
  return schema.document("pastefit apparatus file", "An apparatus with a default material and default grains.");
}

void read_kind(ObjectReader& document, Test& test) {
  std::string word;
  if (!document.text("test", word, Need::optional)) return;
  if (auto known = test_of_kind(word))
    test = std::move(*known);
  else
    document.faults().push_back(no_such_kind(document.place("test"), word));
}

std::optional<Apparatus> read_apparatus(ObjectReader& document, Test& test, const std::optional<fs::path>& folder) {
  std::optional<Apparatus> preset;
  document.object("apparatus", Need::required, [&](ObjectReader& apparatus) {
    std::string name;
    if (folder) apparatus.known("preset");
    const bool named = folder && apparatus.has("preset");
    if (named && apparatus.text("preset", name, Need::required))
      preset = value_or_append(find_preset(name, *folder), apparatus.faults());
    if (preset && preset->test.index() != test.index())
      apparatus.fault("preset", in_quotes(name) + " is an apparatus for another test", "name one for this test");
    else if (preset)
      test = preset->test;
    const Need need = named ? Need::optional : Need::required;
    std::visit([&](auto& one) { describe_apparatus(apparatus, one, need); }, test);
  });
  return preset;
}

void read_material(ObjectReader& document, Test& test, const std::function<void(ObjectReader& material)>& further) {
  const json* content = document.content("material");
  const bool density = content && content->is_number();  // a bare number is the density
  document.object(
      "material", Need::required,
      [&](ObjectReader& material) {
        describe_density(material, specimen_of(test));
        if (further) further(material);
      },
      density ? "write {\"bulk_density_kg_m3\": " + text_of(*content) + "}" : "");
}

void read_grains(ObjectReader& document, Test& test, Need need) {
  document.object(
      "grains", need,
      [&](ObjectReader& reader) {
        GrainSizes grains;
        if (!reader.choice("distribution", grains.distribution, size_distributions, Need::required)) return;
        const bool mono = grains.distribution == SizeDistribution::mono;
        const bool uniform = grains.distribution == SizeDistribution::uniform;
        bool good = true;
        for (const GrainLength& one : grain_lengths)
          if (one.belongs_to(grains.distribution))
            good = reader.number(one.key, grains.*one.value, grain_length, Need::required, mm) && good;
          else
            reader.refuse(one.key, "has no meaning for this distribution", "leave it out");
        if (!good) return;
        if (mono) grains.smallest_m = grains.largest_m = grains.radius_m;
        if (uniform) grains.radius_m = (grains.smallest_m + grains.largest_m) / 2;
        if (grains.smallest_m > grains.radius_m || grains.radius_m > grains.largest_m)
          reader.fault("smallest_mm", "smallest, mean and largest radius are not in order",
                       uniform ? "smallest_mm <= largest_mm" : "smallest_mm <= radius_mm <= largest_mm");
        else
          specimen_of(test).grains = grains;
      },
      R"(e.g. {"distribution": "uniform", "smallest_mm": 6, "largest_mm": 10})");
}

Result<Apparatus> apparatus_from_json(const json& document) {
  Apparatus apparatus;
  const Faults found = read_document(document, "pastefit-rig-1", [&](ObjectReader& reader) {
    Faults& faults = reader.faults();
    reader.text("title", apparatus.title, Need::required);
    Provenance unused;
    read_provenance(reader, unused);
    const std::size_t before = faults.size();
    read_kind(reader, apparatus.test);
    read_apparatus(reader, apparatus.test, std::nullopt);
    read_material(reader, apparatus.test);
    read_grains(reader, apparatus.test, Need::required);
    reader.texts("standards", apparatus.standards, Need::optional);
    reader.text("caution", apparatus.caution, Need::optional);
    apparatus.test = with_default_contact(apparatus.test);
    if (faults.size() == before) append(faults, validate_in_file_words(apparatus.test));
    if (faults.size() == before)
      read_customary(reader, apparatus);  // the possible readings depend on the apparatus
    else
      reader.known("readings");
  });
  if (!found.empty()) return found;
  json simulated = document;
  for (const char* key : not_simulated) simulated.erase(key);
  apparatus.content = simulated.dump();
  return apparatus;
}

Result<Apparatus> read_apparatus_file(const fs::path& file) {
  return read_file(file, [&](const json& document) {
    Result<Apparatus> apparatus = apparatus_from_json(document);
    if (apparatus.ok()) apparatus.value().file = file;
    return apparatus;
  });
}

}  // namespace pastefit
