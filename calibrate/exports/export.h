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

/// What an exporter writes down: a slump test of a card, and the mould filled by pastefit.
struct ExportScene {
  std::string title;  ///< of the card, with the test's name if it has one
  SlumpTest test;
  Packing packing;
  double grain_density_kg_m3 = 0;  ///< such that the mould holds the bulk density
  SizeClasses sizes;
};

/// The card's test to export: the one with this name, or, if that is empty, the first that targets have a deck of, a
/// slump test. Errors: there is no such test; it is, or all are, of another kind.
Result<CardTest> test_to_export(const Card& card, const std::string& name);

/// The scene of such a test in this packing, or in the test's own. Errors: the mould cannot be filled.
Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing);

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

/// A target. Errors of `write`: a law the target lacks and nothing can stand in for.
struct Exporter {
  std::string_view name;
  std::string_view meaning;  ///< what is written, one line
  Result<Export> (*write)(const ExportScene& scene);
};

/// Every exporter. To add one: a file in this folder that ends with a function of that kind, and a row in export.cpp.
std::span<const Exporter> exporters();

Result<Export> export_lammps(const ExportScene& scene);
Result<Export> export_lammps_tables(const ExportScene& scene);
Result<Export> export_liggghts(const ExportScene& scene);
Result<Export> export_yade(const ExportScene& scene);
Result<Export> export_mercurydpm(const ExportScene& scene);
Result<Export> export_csv(const ExportScene& scene);
Result<Export> export_edem_notes(const ExportScene& scene);

}  // namespace pastefit
