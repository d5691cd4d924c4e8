#pragma once

#include <filesystem>

#include "calibrate/study/sheet_table.h"
#include "core/result.h"

namespace pastefit {

/// Reads a laboratory's table (`sheet_table`) from a CSV file, or from the first visible sheet of a workbook (.xlsx,
/// ECMA-376; values as stored, not formulas). The file and the line, which is the row, become the source of each sheet.
/// Faults: those of the table; a file that cannot be read, a damaged or encrypted workbook, a sheet above 64 MiB.
SheetTable read_sheet_table(const std::filesystem::path& file, const Sheet& defaults, Faults& faults);

}  // namespace pastefit
