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
      Exporter{"mercurydpm", "parameters, force table and instructions for MercuryDPM", nullptr, export_mercurydpm},
      Exporter{"csv", "parameters, force table and grains as CSV files", nullptr, export_csv},
      Exporter{"edem-notes", "parameters, force table and instructions for EDEM", nullptr, export_edem_notes}};
  return kExporters;
}

namespace {

/// A test of which there is no deck, as it is told to targets that write the law alone.
ExportScene law_alone(const Card& card, const CardTest& test) {
  ExportScene scene;
  scene.title = title_of(card, test);
  scene.test_of_card = test.test;
  scene.grain_density_kg_m3 = card.material.grain_density_kg_m3.value_or(specimen_of(test.test).bulk_density_kg_m3);
  return scene;
}

Fault no_deck(const Card& card, const CardTest& test, std::string where, std::string what) {
  std::string names;
  for (const Exporter& one : exporters())
    if (one.law && one.law(law_alone(card, test)).ok()) names += (names.empty() ? "" : ", ") + std::string(one.name);
  return {std::move(where), std::move(what),
          names.empty() ? "no target knows its laws" : "take a target that writes its law alone: " + names};
}

}  // namespace

std::string title_of(const Card& card, const CardTest& test) {
  return card.title + (test.name.empty() ? "" : ", test " + test.name);
}

Result<CardTest> test_to_export(const Card& card, const Exporter& exporter, const std::string& name) {
  if (!name.empty()) {
    const auto place = place_of_test(card.tests, name);
    if (!place.ok()) return place.faults();
    const CardTest& test = card.tests[place.value()];
    if (has_deck(test) || exporter.law) return test;
    return no_deck(card, test, "--test " + name,
                   "is a " + std::string(kind_of(test.test)) + " test, of which there is no deck");
  }
  const auto first = std::ranges::find_if(card.tests, has_deck);
  if (first != card.tests.end()) return *first;
  if (exporter.law) return card.tests.front();
  return no_deck(
      card, card.tests.front(), "tests",
      "there is no deck of any of them: the first is a " + std::string(kind_of(card.tests.front().test)) + " test");
}

Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing) {
  ExportScene scene = law_alone(card, test);
  if (!has_deck(test)) return scene;
  scene.test = std::get<SlumpTest>(test.test);
  scene.test.packing_seed = packing.value_or(scene.test.packing_seed);
  scene.test_of_card = scene.test;
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
