#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/exports/application.h"
#include "calibrate/verify/force_curve.h"
#include "core/apparatus/slump/packing.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// Grain sizes in a few classes, for programs with contact parameters per grain type.
struct SizeClasses {
  std::vector<double> radii_m;  ///< one per class, ascending
  std::vector<int> class_of;    ///< one per grain
};

/// Divides the radii into at most `most` classes of equal width between the smallest and the largest one; omits empty
/// classes. The radius of a class preserves the volume of its grains. Equal radii give one class, exactly.
SizeClasses size_classes(std::span<const double> radii_m, int most = 8);

/// Surface of a test, by the name of its region or mesh in a deck.
struct ExportWall {
  std::string name;
  WallContact contact;
};

/// Input of an exporter: a card's material in one of its tests. A slump test has a mould filled by pastefit, for a deck
/// of the whole test; other tests have decks of two grains only.
struct ExportScene {
  std::string title;  ///< of the card, with the test's name, if any
  Test test;
  double grain_density_kg_m3 = 0;  ///< of a grain in the packing; gives the bulk density in the mould
  Packing packing = {};            ///< filled mould of a slump test; empty for other tests
  SizeClasses sizes = {};          ///< of the packing's grains; the mean radius for other tests
  std::optional<double> card_density_kg_m3 = std::nullopt;  ///< of a grain; mean over the card's packings
  std::optional<Application> application = std::nullopt;    ///< machine in which to simulate them, in place of the test

  const SlumpTest* slump() const { return std::get_if<SlumpTest>(&test); }
  const ContactModel& contact() const { return specimen_of(test).contact; }
  const GrainSizes& grains() const { return specimen_of(test).grains; }
  double radius_m() const { return grains().radius_m; }
  /// Surfaces that the grains meet: parts of the machine, mould and table, or tools of granules. None in a drop test,
  /// whose plate has the grains' material.
  std::vector<ExportWall> walls() const;
  GrainPair mean_pair() const { return {radius_m(), radius_m(), radius_m()}; }
};

/// Density of the deck's grains and, if different, that of the card: "3105.1 kg/m^3 in this packing (3173 on the card,
/// the mean of its packings)".
std::string grain_density_in_words(const ExportScene& scene);

struct ExportFile {
  std::string name;  ///< in the export folder; may contain subfolders separated by /
  std::string content;
};

/// "overlap_m,attraction_n,repulsion_n" of two grains of mean radius, in 2,001 rows from the rupture gap to an overlap
/// of a tenth of the radius, including touch. Both forces are positive; the attraction pulls.
ExportFile force_csv(const ExportScene& scene);

/// "x_m,y_m,z_m,radius_m" of the filled mould.
ExportFile grains_csv(const ExportScene& scene);

/// Appends parameters, forces and, if the mould is filled, its grains to `files`.
std::vector<ExportFile> law_files(const ExportScene& scene, std::vector<ExportFile> files = {});

/// Laws as text and formulas with their SI constants, for manual input into another program.
std::string laws_in_words(const ExportScene& scene);

/// Result of an export.
struct Export {
  std::vector<ExportFile> files;
  std::vector<std::string> notes;  ///< what the target cannot represent, with numbers
  std::string instructions = {};   ///< how to run it
  std::string heap = {};           ///< dump written by the deck of the whole test; empty: no such deck
  std::string own_law = {};        ///< study settings that avoid a substitute law; empty: the law is the card's
};

/// Export target. Errors: a law that the target lacks, without a substitute.
struct Exporter {
  std::string_view name;
  std::string_view meaning;  ///< output in one line
  Result<Export> (*write)(const ExportScene& scene);
  bool takes_applications = false;
};

/// Selects the test to export: by name; if `name` is empty, the first slump test, which has a deck, otherwise the first
/// test. Error: no such test.
Result<CardTest> test_to_export(const Card& card, const std::string& name);

/// True if there is a deck of the whole test, not only of two grains.
bool has_deck(const Test& test);

/// Input for any target. A slump test's mould is filled with this packing, or the test's own. `fill`: options of the
/// filling. Errors: the mould cannot be filled, or its grains exceed the memory.
Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing,
                                 const RunOptions& fill = {});

/// Every exporter. To add one: a file in this folder with a function of type `Exporter::write`, and a row in
/// export.cpp.
std::span<const Exporter> exporters();

/// Finds an exporter by name. Error: unknown name.
Result<Exporter> exporter_named(const std::string& name);

Result<Export> export_lammps(const ExportScene& scene);
Result<Export> export_liggghts(const ExportScene& scene);
Result<Export> export_yade(const ExportScene& scene);
Result<Export> export_mercurydpm(const ExportScene& scene);
Result<Export> export_csv(const ExportScene& scene);
Result<Export> export_edem_notes(const ExportScene& scene);

inline const std::string kExportNotes = "NOTES.txt";

/// Options of an export; the commands in the notes repeat them.
struct ExportRequest {
  std::string card_file;
  std::string test;                      ///< name; empty: see `test_to_export`
  std::optional<std::uint64_t> packing;  ///< empty: the test's own
  bool unconfirmed = false;              ///< accept an unconfirmed card
  RunOptions fill = {};                  ///< options of the filling
  std::string application = {};          ///< file of a machine; empty: the test
};

/// Exports a card, with notes as the last file: losses, how to run it, the expected heap and the command for
/// comparison. For unconfirmed cards, every file about the material begins with the reason. Errors, all at once: the
/// card is unconfirmed and the request does not accept it; no such test; the mould cannot be filled; the target lacks
/// the law.
Result<Export> export_card(const Card& card, const Exporter& exporter, const ExportRequest& request);

}  // namespace pastefit
