#include "calibrate/exports/export.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "calibrate/base/text.h"
#include "calibrate/study/tests.h"

namespace pastefit {

std::vector<ExportWall> walls_of(const Test& test) {
  return std::visit(
      [](const auto& one) -> std::vector<ExportWall> {
        if constexpr (requires { one.mould_wall; }) return {{"mould", one.mould_wall}, {"table", one.table_wall}};
        if constexpr (requires { one.tools; }) return {{"tools", one.tools}};
        return {};
      },
      test);
}

std::string grain_density_in_words(const ExportScene& scene) {
  std::string own = format("%.9g kg/m^3", scene.grain_density_kg_m3);
  if (!scene.card_density_kg_m3 || *scene.card_density_kg_m3 == scene.grain_density_kg_m3) return own;
  return own + format(" in this packing (%.9g on the card, the mean of its packings)", *scene.card_density_kg_m3);
}

std::span<const Exporter> exporters() {
  static constexpr std::array kExporters{
      Exporter{"lammps", "deck for LAMMPS, and the engine's laws as a style for it: slump test, or two grains",
               export_lammps},
      Exporter{"liggghts", "deck for LIGGGHTS, with its nearest law: slump test (step 1), or two grains",
               export_liggghts},
      Exporter{"yade", "Python module and scripts for Yade: slump test (step 1), or two grains", export_yade},
      Exporter{"mercurydpm", "parameters, force table and instructions for MercuryDPM", export_mercurydpm},
      Exporter{"csv", "parameters, force table and grains as CSV files", export_csv},
      Exporter{"edem-notes", "parameters, force table and instructions for EDEM", export_edem_notes}};
  return kExporters;
}

Result<Exporter> exporter_named(const std::string& name) {
  const auto known = exporters();
  if (const auto found = std::ranges::find(known, name, &Exporter::name); found != known.end()) return *found;
  std::set<std::string, std::less<>> names;
  std::string list;
  for (const auto& one : known) {
    names.emplace(one.name);
    list += (list.empty() ? "" : ", ") + std::string(one.name);
  }
  std::string small;
  for (const char letter : name) small += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  auto near = nearest(small, names);
  for (const std::string& one : names)
    if (!small.empty() && one.starts_with(small) && (!near || *near != small)) near = one;
  return Fault{"--to " + printable(name), "is no target of an export",
               near ? "did you mean '" + *near + "'?" : "one of " + list};
}

std::string title_of(const Card& card, const CardTest& test) {
  return title_of(card) + (test.name.empty() ? "" : ", test " + test.name);
}

Result<CardTest> test_to_export(const Card& card, const std::string& name) {
  if (!name.empty()) {
    const auto place = place_of_test(card.tests, name);
    if (!place.ok()) return place.faults();
    return card.tests[place.value()];
  }
  const auto slump = std::ranges::find_if(
      card.tests, [](const CardTest& test) { return std::holds_alternative<SlumpTest>(test.test); });
  return slump != card.tests.end() ? *slump : card.tests.front();
}

bool has_deck(const Test& test) {
  return std::holds_alternative<SlumpTest>(test);
}

Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing) {
  ExportScene scene;
  scene.title = title_of(card, test);
  scene.test = test.test;
  scene.card_density_kg_m3 = card.material.grain_density_kg_m3;
  scene.grain_density_kg_m3 = card.material.grain_density_kg_m3.value_or(specimen_of(test.test).bulk_density_kg_m3);
  scene.sizes.radii_m = {scene.radius_m()};
  auto* const slump = std::get_if<SlumpTest>(&scene.test);
  if (!slump) return scene;
  slump->packing_seed = packing.value_or(slump->packing_seed);
  const auto filled = fill_mould(*slump);
  scene.packing = filled->failure ? *filled : full_mould(*slump, *filled);
  if (const auto& failure = scene.packing.failure)
    return Fault{"packing " + std::to_string(slump->packing_seed), "the mould could not be filled: " + failure->message,
                 "take another seed with --packing, or finer grains with pastefit rescale"};
  scene.grain_density_kg_m3 = grain_density(*slump, scene.packing);
  scene.sizes = size_classes(scene.packing.radii);
  return scene;
}

SizeClasses size_classes(std::span<const double> radii, int most) {
  SizeClasses out;
  if (radii.empty()) return out;
  const auto [smallest, largest] = std::ranges::minmax(radii);
  const double width = (largest - smallest) / most;
  std::vector<double> cubes(static_cast<std::size_t>(most));
  std::vector<int> counts(cubes.size()), places(cubes.size());
  for (const double radius : radii) {
    const int bin = width > 0 ? std::min(static_cast<int>((radius - smallest) / width), most - 1) : 0;
    out.class_of.push_back(bin);
    cubes[bin] += radius * radius * radius;
    ++counts[bin];
  }
  for (std::size_t bin = 0; bin < cubes.size(); ++bin) {
    places[bin] = static_cast<int>(out.radii_m.size());
    if (counts[bin] > 0) out.radii_m.push_back(width > 0 ? std::cbrt(cubes[bin] / counts[bin]) : smallest);
  }
  for (std::size_t i = 0; i < radii.size(); ++i) {
    out.class_of[i] = places[out.class_of[i]];
    out.largest_change = std::max(out.largest_change, std::abs(out.radii_m[out.class_of[i]] / radii[i] - 1));
  }
  return out;
}

}  // namespace pastefit
