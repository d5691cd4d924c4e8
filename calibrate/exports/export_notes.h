#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "calibrate/card/card.h"
#include "calibrate/exports/export.h"

namespace pastefit {

inline const std::string kExportNotes = "NOTES.txt";

/// What was asked for, as the commands in the notes repeat it.
struct ExportRequest {
  std::string card_file;
  std::string test;                      ///< name; empty: the card's own choice
  std::optional<std::uint64_t> packing;  ///< empty: the test's own
};

/// The notes beside an export, for a person: what is lost, how to run it, the heap to expect and how to compare it.
std::string export_notes(const Export& written, const Exporter& exporter, const Card& card, const CardTest& test,
                         const ExportRequest& request);

/// A card that is not confirmed leaves pastefit only if the user accepts that. Error: it does not.
Faults unconfirmed_faults(const Card& card, bool accepted);

/// Writes why the card is not confirmed as the first line of every file about its material; nothing for one that is.
void mark_unconfirmed(const Card& card, Export& written);

}  // namespace pastefit
