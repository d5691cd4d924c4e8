#include "calibrate/exports/export.h"

#include <array>

namespace pastefit {

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

std::string targets_of_laws() {
  std::string names;
  for (const Exporter& one : exporters())
    if (one.law) names += (names.empty() ? "" : ", ") + std::string(one.name);
  return names;
}

}  // namespace

Result<ExportScene> export_scene(const Card& card, std::uint64_t packing) {
  const auto* slump = std::get_if<SlumpTest>(&card.test);
  if (!slump)
    return Fault{"test", "is a " + std::string(kind_of(card.test)) + " test, of which there is no deck",
                 "take a target that writes the law alone: " + targets_of_laws()};
  ExportScene scene;
  scene.card = card;
  scene.test = *slump;
  scene.test.packing_seed = packing;
  const auto poured = fill_mould(scene.test);
  scene.packing = poured->failure ? *poured : full_mould(scene.test, *poured);
  if (const auto& failure = scene.packing.failure)
    return Fault{"packing " + std::to_string(packing), "the mould could not be filled: " + failure->message,
                 "take another seed with --packing, or finer grains with pastefit rescale"};
  scene.grain_density_kg_m3 = grain_density(scene.test, scene.packing);
  scene.sizes = size_classes(scene.packing.radii);
  return scene;
}

Result<Export> export_card(const Card& card, const Exporter& exporter, std::uint64_t packing) {
  if (exporter.law && !std::holds_alternative<SlumpTest>(card.test)) {
    const double bulk_density = specimen_of(card.test).bulk_density_kg_m3;
    return exporter.law({card, card.grain_density_kg_m3.value_or(bulk_density)});
  }
  const auto scene = export_scene(card, packing);
  if (!scene.ok()) return scene.faults();
  return exporter.write(scene.value());
}

}  // namespace pastefit
