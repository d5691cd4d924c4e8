#include "calibrate/study/apparatus.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "calibrate/base/data_folders.h"
#include "calibrate/base/foreign_text.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/parameters.h"

namespace pastefit {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr Range grain_length{0, 500, true};
constexpr std::array not_simulated{"readings", "caution"};  // keys of apparatus files

std::optional<Apparatus> read_preset(const std::string& name, const fs::path& folder, ObjectReader& apparatus) {
  Faults& faults = apparatus.faults();
  std::set<std::string, std::less<>> known;
  for (const fs::path& candidate : apparatus_folders(folder)) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(candidate, error)) {
      if (entry.path().extension() != ".json") continue;
      if (entry.path().stem() == name) {
        Result<Apparatus> found = read_apparatus_file(entry.path().lexically_normal());
        if (found) return std::move(found).value();
        faults.insert(faults.end(), found.faults().begin(), found.faults().end());
        return std::nullopt;
      }
      known.insert(entry.path().stem().string());
    }
  }
  std::string list;
  for (const std::string& word : known) list += (list.empty() ? "" : ", ") + word;
  const std::optional<std::string> near = nearest(name, known);
  apparatus.fault("preset", "there is no preset " + json(name).dump(),
                  (near ? "did you mean \"" + *near + "\"? Presets: " : "presets: ") +
                      (list.empty() ? "none found; set PASTEFIT_DATA_DIR to the data folder of pastefit" : list));
  return std::nullopt;
}

/// "readings": by the keys of laboratory files.
void read_customary(ObjectReader& document, Apparatus& apparatus) {
  document.object("readings", Need::optional, [&](ObjectReader& readings) {
    for (const ReadingKind& kind : reading_kinds(apparatus.test)) {
      if (kind.key.empty() || kind.from_outline) continue;
      if (kind.lack) {
        readings.refuse(kind.key, std::string(kind.lack->what), std::string(kind.lack->remedy));
        continue;
      }
      CustomaryReading one{std::string(kind.key)};
      const auto read = [&](ObjectReader& reading) {
        reading.number("value", one.value, {kind.possible.smallest, kind.possible.largest}, Need::required);
        reading.number("standard_deviation", one.standard_deviation, {1e-6, 10000}, Need::required);
      };
      if (readings.object(kind.key, Need::optional, read)) apparatus.readings.push_back(std::move(one));
    }
  });
}

std::size_t readings_taken(const Test& test) {
  const auto own_kinds = reading_kinds(test);
  return static_cast<std::size_t>(std::ranges::count_if(own_kinds, [](const ReadingKind& kind) { return !kind.lack; }));
}

}  // namespace

std::string caution_of(const Apparatus& preset, const Test& test) {
  return readings_taken(test) > readings_taken(preset.test) ? "" : preset.caution;
}

Result<Apparatus> find_preset(const std::string& name, const fs::path& folder) {
  Faults faults;
  const json named{{"preset", name}};
  std::optional<Apparatus> found;
  {
    ObjectReader reader(named, "apparatus", faults);
    reader.known("preset");
    found = read_preset(name, folder, reader);
  }
  if (!found) return faults;
  return std::move(*found);
}

std::string note_on_preset(const Apparatus& preset) {
  std::vector<fs::path> shipped = apparatus_folders({});
  shipped.erase(shipped.begin());
  const auto is_here = [&](const fs::path& folder) {
    std::error_code error;
    return fs::equivalent(folder, preset.file.parent_path(), error);
  };
  if (std::ranges::any_of(shipped, is_here)) return {};
  return "the preset " + one_line(preset.file.stem().string()) + " is " + one_line(preset.file.string()) +
         ", not the shipped one";
}

std::vector<fs::path> apparatus_folders(const fs::path& folder) {
  std::vector<fs::path> folders{folder / ".." / "apparatus"};
  for (const fs::path& data : data_folders()) folders.push_back(data / "apparatus");
  return folders;
}

void read_provenance(ObjectReader& document, Provenance& provenance) {
  document.object("provenance", Need::required, [&](ObjectReader& reader) {
    reader.text("source", provenance.source, Need::required);
    reader.text("licence", provenance.licence, Need::optional);
    reader.text("notes", provenance.notes, Need::optional);
    reader.flag("twin", provenance.twin, Need::optional);
  });
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
    if (named && apparatus.text("preset", name, Need::required)) preset = read_preset(name, *folder, apparatus);
    if (preset && preset->test.index() != test.index())
      apparatus.fault("preset", in_quotes(name) + " is an apparatus for another test", "name one for this test");
    else if (preset)
      test = preset->test;
    read_apparatus(apparatus, test, named ? Need::optional : Need::required);
  });
  return preset;
}

void read_material(ObjectReader& document, Test& test, const std::function<void(ObjectReader& material)>& further) {
  const json* content = document.content("material");
  const bool density = content && content->is_number();  // a bare number can be nothing else
  document.object(
      "material", Need::required,
      [&](ObjectReader& material) {
        material.number("bulk_density_kg_m3", specimen_of(test).bulk_density_kg_m3, {100, 10000}, Need::required);
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
        const auto length = [&](std::string_view key, double& target, bool has_it) {
          if (has_it)
            good = reader.number(key, target, grain_length, Need::required, mm) && good;
          else
            reader.refuse(key, "has no meaning for this distribution", "leave it out");
        };
        length("radius_mm", grains.radius_m, !uniform);
        length("standard_deviation_mm", grains.standard_deviation_m, !mono && !uniform);
        length("smallest_mm", grains.smallest_m, !mono);
        length("largest_mm", grains.largest_m, !mono);
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

bool values_are_good(const Faults& faults, std::size_t first) {
  return std::all_of(faults.begin() + static_cast<std::ptrdiff_t>(first), faults.end(),
                     [](const Fault& fault) { return fault.what == unknown_key; });
}

Result<Apparatus> apparatus_from_json(const json& document) {
  Faults faults;
  if (!has_format(document, "pastefit-rig-1", faults)) return faults;
  Apparatus apparatus;
  {
    ObjectReader reader(document, "", faults);
    reader.known("format");
    reader.text("title", apparatus.title, Need::required);
    read_provenance(reader, apparatus.provenance);
    const std::size_t before = faults.size();
    read_kind(reader, apparatus.test);
    read_apparatus(reader, apparatus.test, std::nullopt);
    read_material(reader, apparatus.test);
    read_grains(reader, apparatus.test, Need::required);
    reader.text("caution", apparatus.caution, Need::optional);
    apparatus.test = with_default_contact(apparatus.test);
    if (faults.size() == before)
      for (Fault& fault : validate_in_file_words(apparatus.test)) faults.push_back(std::move(fault));
    if (faults.size() == before)
      read_customary(reader, apparatus);  // what a reading may be depends on the apparatus
    else
      reader.known("readings");
  }
  if (!faults.empty()) return faults;
  json simulated = document;
  for (const char* key : not_simulated) simulated.erase(key);
  apparatus.content = simulated.dump();
  return apparatus;
}

Result<Apparatus> read_apparatus_file(const fs::path& file) {
  Faults faults;
  const std::optional<json> document = read_json(file, faults);
  if (!document) return faults;
  Result<Apparatus> apparatus = apparatus_from_json(*document);
  if (apparatus.ok()) apparatus.value().file = file;
  if (apparatus.ok() && faults.empty()) return apparatus;
  if (!apparatus.ok())
    for (Fault& fault : in_file(apparatus.faults(), file)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace pastefit
