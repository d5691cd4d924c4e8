#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "calibrate/card/card.h"
#include "calibrate/verify/force_curve.h"
#include "core/apparatus/slump/packing.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// Grain sizes as a few classes, for programs whose contact parameters belong to types of grains.
struct SizeClasses {
  std::vector<double> radii_m;  ///< one for each class, ascending
  std::vector<int> class_of;    ///< of each grain
  double largest_change = 0;    ///< of a grain's radius when it takes that of its class, relative
};

/// At most `most` classes of equal width between the smallest and the largest radius, empty ones left out. The radius
/// of a class is the one that keeps the volume of its grains. One class, exactly, if all radii are the same.
SizeClasses size_classes(std::span<const double> radii_m, int most = 8);

/// A surface that grains meet in a test, by the name that its region or mesh has in a deck.
struct ExportWall {
  std::string name;
  WallContact contact;
};

/// What a target is told: the material in a card's test, of whatever kind that is, and of a slump test the mould filled
/// by pastefit, of which decks are written. Of other tests there are decks of two grains.
struct ExportScene {
  std::string title;  ///< of the card, with the test's name if it has one
  Test test;
  double grain_density_kg_m3 = 0;  ///< of the grains of the packing, which fill the mould with the bulk density
  Packing packing = {};            ///< the filled mould of a slump test; empty for other tests
  SizeClasses sizes = {};          ///< of its grains; of other tests the mean radius
  std::optional<double> card_density_kg_m3 = std::nullopt;  ///< of a grain: the card's mean over its packings

  const SlumpTest* slump() const { return std::get_if<SlumpTest>(&test); }
  const ContactModel& contact() const { return specimen_of(test).contact; }
  const GrainSizes& grains() const { return specimen_of(test).grains; }
  double radius_m() const { return grains().radius_m; }
  /// Two grains of the mean radius.
  GrainPair mean_pair() const { return {radius_m(), radius_m(), radius_m()}; }
};

/// "3105.1 kg/m^3 in this packing (3173 on the card, the mean of its packings)": the density of the deck's grains and,
/// where it is another, the card's.
std::string grain_density_in_words(const ExportScene& scene);

/// Mould and table of a slump test, the tools of granules; nothing of a drop test, whose plate is of the grains'
/// material.
std::vector<ExportWall> walls_of(const Test& test);

struct ExportFile {
  std::string name;  ///< in the folder of the export, with / where it has folders of its own
  std::string content;
};

/// A card in the words of another program.
struct Export {
  std::vector<ExportFile> files;
  std::vector<std::string> notes;  ///< what the target cannot represent, each with a number; for people
  std::string instructions = {};   ///< how to run it
  std::string heap = {};           ///< the dump that the deck of the whole test leaves; empty: there is no such deck
  std::string own_law = {};        ///< where another law stands in: what to choose in a study so that none has to
};

/// A target. Errors: a law the target lacks and nothing can stand in for.
struct Exporter {
  std::string_view name;
  std::string_view meaning;  ///< what is written, one line
  Result<Export> (*write)(const ExportScene& scene);
};

/// What a card's export is called: its title, with the test's name if it has one.
std::string title_of(const Card& card, const CardTest& test);

/// The card's test to export: the one with this name, or, if that is empty, its first slump test, of which there are
/// decks, or else the first. Error: there is no such test.
Result<CardTest> test_to_export(const Card& card, const std::string& name);

/// Whether there are decks of the whole test, not only of two grains.
bool has_deck(const Test& test);

/// A card's test for any target, a slump test with the mould filled by this packing, or by the test's own. Errors: the
/// mould cannot be filled, or its grains do not fit into the memory. `fill`: how it is filled.
Result<ExportScene> export_scene(const Card& card, const CardTest& test, std::optional<std::uint64_t> packing,
                                 const RunOptions& fill = {});

/// Every exporter. To add one: a file in this folder that ends with a function of that kind, and a row in export.cpp.
std::span<const Exporter> exporters();

/// The exporter with this name. Error: there is none.
Result<Exporter> exporter_named(const std::string& name);

Result<Export> export_lammps(const ExportScene& scene);
Result<Export> export_liggghts(const ExportScene& scene);
Result<Export> export_yade(const ExportScene& scene);
Result<Export> export_mercurydpm(const ExportScene& scene);
Result<Export> export_csv(const ExportScene& scene);
Result<Export> export_edem_notes(const ExportScene& scene);

inline const std::string kExportNotes = "NOTES.txt";

/// What was asked for, as the commands in the notes repeat it.
struct ExportRequest {
  std::string card_file;
  std::string test;                      ///< name; empty: the card's own choice
  std::optional<std::uint64_t> packing;  ///< empty: the test's own
  bool unconfirmed = false;              ///< a card that is not confirmed is accepted
  RunOptions fill = {};                  ///< how the mould is filled
};

/// The card in the words of a target, with notes for a person as the last file: what is lost, how to run it, the heap
/// to expect and how to compare it. Every file about the material of a card that is not confirmed begins with the
/// reason. Errors, all at once: the card is not confirmed and the request does not accept that; it has no such test;
/// its mould cannot be filled; the target lacks its law.
Result<Export> export_card(const Card& card, const Exporter& exporter, const ExportRequest& request);

}  // namespace pastefit
