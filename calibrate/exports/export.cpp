#include "calibrate/exports/export.h"

#include <algorithm>
#include <array>

#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

bool has_deck(const CardTest& test) {
  return std::holds_alternative<SlumpTest>(test.test);
}

}  // namespace

std::span<const Exporter> exporters() {
  static constexpr std::array kExporters{
      Exporter{"lammps", "deck of the slump test for LAMMPS, and the card's laws as styles for it", export_lammps},
      Exporter{"lammps-tables",
               "deck of the slump test, step 1, for LAMMPS as it stands, with the attraction as tables",
               export_lammps_tables},
      Exporter{"liggghts", "deck of the slump test, step 1, for LIGGGHTS, with its nearest law", export_liggghts},
      Exporter{"yade", "Python module and script of the slump test, step 1, for Yade", export_yade},
      Exporter{"mercurydpm", "parameters, force table and instructions for MercuryDPM", export_mercurydpm},
      Exporter{"csv", "parameters, force table and grains as CSV files", export_csv},
      Exporter{"edem-notes", "parameters, force table and instructions for EDEM", export_edem_notes}};
  return kExporters;
}

Result<CardTest> test_to_export(const Card& card, const std::string& name) {
  if (!name.empty()) {
    const auto place = place_of_test(card.tests, name);
    if (!place.ok()) return place.faults();
    const CardTest& test = card.tests[place.value()];
    if (has_deck(test)) return test;
    return Fault{"--test " + name, "is a " + std::string(kind_of(test.test)) + " test, which no target has a deck of",
                 "name a slump test"};
  }
  const auto first = std::ranges::find_if(card.tests, has_deck);
  if (first != card.tests.end()) return *first;
  return Fault{"tests", "no target has a deck of any of them", "calibrate a slump test beside them, in one study"};
}

Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing) {
  ExportScene scene;
  scene.title = card.title + (test.name.empty() ? "" : ", test " + test.name);
  scene.test = std::get<SlumpTest>(test.test);
  scene.test.packing_seed = packing.value_or(scene.test.packing_seed);
  const auto poured = fill_mould(scene.test);
  scene.packing = poured->failure ? *poured : full_mould(scene.test, *poured);
  if (const auto& failure = scene.packing.failure)
    return Fault{"packing " + std::to_string(scene.test.packing_seed),
                 "the mould could not be filled: " + failure->message,
                 "take another seed with --packing, or finer grains with pastefit rescale"};
  scene.grain_density_kg_m3 = grain_density(scene.test, scene.packing);
  scene.sizes = size_classes(scene.packing.radii);
  return scene;
}

}  // namespace pastefit
