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
      Exporter{"mercurydpm", "parameters, force table and instructions for MercuryDPM", export_mercurydpm},
      Exporter{"csv", "parameters, force table and grains as CSV files", export_csv},
      Exporter{"edem-notes", "parameters, force table and instructions for EDEM", export_edem_notes}};
  return kExporters;
}

Result<ExportScene> export_scene(const Card& card, std::uint64_t packing) {
  const auto* slump = std::get_if<SlumpTest>(&card.test);
  if (!slump)
    return Fault{"test", "is a " + std::string(kind_of(card.test)) + " test, which no target has a deck of",
                 "calibrate a slump test beside it, in one study, and name that first"};
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

}  // namespace pastefit
