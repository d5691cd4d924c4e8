#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/exports/size_classes.h"
#include "core/rigs/slump/packing.h"

namespace pastefit {

/// What every target can be told: the material in a card's test, of whatever kind that is.
struct ExportLaw {
  std::string title;  ///< of the card, with the test's name if it has one
  Test test_of_card;
  double grain_density_kg_m3 = 0;
  Packing packing = {};  ///< the filled mould of a slump test; empty for other tests
};

/// What a deck is written from: a slump test of a card, and the mould filled by pastefit. Other tests have the law
/// alone.
struct ExportScene : ExportLaw {
  SlumpTest test = {};
  SizeClasses sizes = {};
};

struct ExportFile {
  std::string name;  ///< in the folder of the export, with / where it has folders of its own
  std::string content;
};

/// A card in the words of another program.
struct Export {
  std::vector<ExportFile> files;
  std::vector<std::string> notes;  ///< what the target cannot represent, each with a number; for people
  std::string instructions = {};   ///< how to run it
};

/// A target, which has a deck of the test or else the law alone. Errors: a law the target lacks and nothing can stand
/// in for.
struct Exporter {
  std::string_view name;
  std::string_view meaning;  ///< what is written, one line
  Result<Export> (*deck)(const ExportScene& scene);
  Result<Export> (*law)(const ExportLaw& law) = nullptr;

  /// Requirement: the scene's test is from `test_to_export`.
  Result<Export> write(const ExportScene& scene) const { return deck ? deck(scene) : law(scene); }
};

/// What a card's export is called: its title, with the test's name if it has one.
std::string title_of(const Card& card, const CardTest& test);

/// The card's test to export: the one with this name, or, if that is empty, the first one that the target has a deck of
/// (a slump test), or else the first of all if it writes the law alone. Errors: there is no such test; there is no deck
/// of it.
Result<CardTest> test_to_export(const Card& card, const Exporter& exporter, const std::string& name);

/// A card's test for any target: with the mould filled by this packing, or by the test's own, if it is a slump test;
/// else the law alone. Errors: the mould cannot be filled.
Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing);

/// Every exporter. To add one: a file in this folder that ends with a function of that kind, and a row in export.cpp.
std::span<const Exporter> exporters();

Result<Export> export_lammps(const ExportScene& scene);
Result<Export> export_lammps_tables(const ExportScene& scene);
Result<Export> export_liggghts(const ExportScene& scene);
Result<Export> export_yade(const ExportScene& scene);
Result<Export> export_mercurydpm(const ExportLaw& law);
Result<Export> export_csv(const ExportLaw& law);
Result<Export> export_edem_notes(const ExportLaw& law);

}  // namespace pastefit
