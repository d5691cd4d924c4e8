#include "calibrate/study/rig.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "calibrate/study/json_reader.h"
#include "calibrate/study/names.h"
#include "calibrate/study/parameters.h"

namespace pastefit {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr double mm = 1000;           // millimetres in a metre
constexpr double diameter_mm = 2000;  // diameter in millimetres of a circle with a radius of one metre
constexpr Range apparatus_length{0, 5000, true};
constexpr Range grain_length{0, 500, true};

std::optional<Rig> read_preset(const std::string& name, const fs::path& folder, ObjectReader& apparatus) {
  Faults& faults = apparatus.faults();
  std::set<std::string, std::less<>> known;
  for (const fs::path& candidate : rig_folders(folder)) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(candidate, error)) {
      if (entry.path().extension() != ".json") continue;
      if (entry.path().stem() == name) {
        Result<Rig> rig = read_rig(entry.path());
        if (rig) return std::move(rig).value();
        faults.insert(faults.end(), rig.faults().begin(), rig.faults().end());
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

void read_dimensions(ObjectReader& apparatus, SlumpTable& test, Need need) {
  apparatus.object("mould", need, [&](ObjectReader& mould) {
    mould.number("base_diameter_mm", test.mould.base_radius_m, apparatus_length, need, diameter_mm);
    mould.number("top_diameter_mm", test.mould.top_radius_m, apparatus_length, need, diameter_mm);
    mould.number("height_mm", test.mould.height_m, apparatus_length, need, mm);
  });
  apparatus.number("table_length_mm", test.table_length_m, {0, 20000, true}, need, mm);
  apparatus.number("lift_velocity_mm_s", test.lift_velocity_m_s, {0, 5000, true}, need, mm);
  const Need plate_need = test.drop ? Need::optional : Need::required;
  apparatus.nullable_object("drop_plate", test.drop, Need::optional, [&](ObjectReader& plate, DropPlate& drop) {
    plate.number("length_mm", drop.length_m, {0, 20000, true}, plate_need, mm);
    plate.number("mass_kg", drop.mass_kg, {0, 1000, true}, plate_need);
    plate.number("lift_height_mm", drop.lift_height_m, {0, 1000, true}, plate_need, mm);
    plate.number("lift_duration_s", drop.lift_duration_s, {0, 60, true}, Need::optional);
  });
  apparatus.object("reading", need, [&](ObjectReader& reading) {
    reading.choice("height", test.reading.height, height_readings, need);
    reading.number("probe_diameter_mm", test.reading.probe_diameter_m, {0, 1000, true}, Need::optional, mm);
    reading.number("sag_window_mm", test.reading.sag_window_m, {0, 1000, true}, Need::optional, mm);
  });
}

}  // namespace

std::vector<fs::path> rig_folders(const fs::path& folder) {
  std::vector<fs::path> folders{folder / ".." / "rigs"};
  if (const char* data = std::getenv("PASTEFIT_DATA_DIR"); data && *data) folders.push_back(fs::path(data) / "rigs");
  folders.push_back(fs::path(PASTEFIT_SOURCE_DATA_DIR) / "rigs");
  folders.push_back(fs::path(PASTEFIT_INSTALL_DATA_DIR) / "rigs");
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

std::optional<Rig> read_apparatus(ObjectReader& document, SlumpTable& test, const std::optional<fs::path>& folder) {
  std::optional<Rig> preset;
  document.object("apparatus", Need::required, [&](ObjectReader& apparatus) {
    std::string name;
    const bool named = folder && apparatus.has("preset");
    if (named && apparatus.text("preset", name, Need::required)) preset = read_preset(name, *folder, apparatus);
    if (preset) test = preset->test;
    read_dimensions(apparatus, test, named ? Need::optional : Need::required);
  });
  return preset;
}

void read_material(ObjectReader& document, SlumpTable& test) {
  document.object("material", Need::required, [&](ObjectReader& material) {
    material.number("bulk_density_kg_m3", test.bulk_density_kg_m3, {100, 10000}, Need::required);
  });
}

void read_grains(ObjectReader& document, SlumpTable& test, Need need) {
  document.object("grains", need, [&](ObjectReader& reader) {
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
      test.grains = grains;
  });
}

bool values_are_good(const Faults& faults, std::size_t first) {
  return std::all_of(faults.begin() + static_cast<std::ptrdiff_t>(first), faults.end(),
                     [](const Fault& fault) { return fault.what == unknown_key; });
}

Faults validate_in_file_words(const SlumpTable& test) {
  static constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"mould.base_radius_m", "apparatus.mould.base_diameter_mm"},
      {"mould.top_radius_m", "apparatus.mould.top_diameter_mm"},
      {"mould.height_m", "apparatus.mould.height_mm"},
      {"mould_wall", "parameters: mould_wall"},
      {"mould", "apparatus.mould"},
      {"table_wall", "parameters: table_wall"},
      {"table_length_m", "apparatus.table_length_mm"},
      {"lift_velocity_m_s", "apparatus.lift_velocity_mm_s"},
      {"drop.length_m", "apparatus.drop_plate.length_mm"},
      {"drop.lift_height_m", "apparatus.drop_plate.lift_height_mm"},
      {"drop", "apparatus.drop_plate"},
      {"reading.probe_diameter_m", "apparatus.reading.probe_diameter_mm"},
      {"reading.sag_window_m", "apparatus.reading.sag_window_mm"},
      {"bulk_density_kg_m3", "material.bulk_density_kg_m3"},
      {"grains.radius_m", "grains.radius_mm"},
      {"grains.standard_deviation_m", "grains.standard_deviation_mm"},
      {"grains.smallest_m", "grains.smallest_mm"},
      {"grains.largest_m", "grains.largest_mm"},
      {"contact", "parameters: contact"}};
  Faults faults = validate(test);
  for (Fault& fault : faults) {
    for (const auto& [ours, theirs] : words) {
      if (!fault.where.starts_with(ours)) continue;
      if (fault.where.size() > ours.size() && fault.where[ours.size()] != '.') continue;
      fault.where.replace(0, ours.size(), theirs);
      break;
    }
  }
  return faults;
}

Result<Rig> rig_from_json(const json& document) {
  Faults faults;
  if (!has_format(document, "pastefit-rig-1", faults)) return faults;
  Rig rig;
  {
    ObjectReader reader(document, "", faults);
    reader.known("format");
    reader.text("title", rig.title, Need::required);
    read_provenance(reader, rig.provenance);
    const std::size_t before = faults.size();
    read_apparatus(reader, rig.test, std::nullopt);
    read_material(reader, rig.test);
    read_grains(reader, rig.test, Need::required);
    rig.test = with_contact_of(rig.test, usual_values());
    if (faults.size() == before)
      for (Fault& fault : validate_in_file_words(rig.test)) faults.push_back(std::move(fault));
  }
  if (!faults.empty()) return faults;
  rig.content = document.dump();
  return rig;
}

Result<Rig> read_rig(const fs::path& file) {
  Faults faults;
  const std::optional<json> document = read_json(file, faults);
  if (!document) return faults;
  Result<Rig> rig = rig_from_json(*document);
  if (rig.ok() && faults.empty()) return rig;
  if (!rig.ok())
    for (Fault& fault : in_file(rig.faults(), file)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace pastefit
