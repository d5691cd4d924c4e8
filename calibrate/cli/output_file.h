#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibrate/card/card.h"
#include "core/result.h"

namespace pastefit {

/// True for "-", names such as /dev/stdout, devices and FIFOs: content is written there, and no file is replaced.
bool is_stream(const std::filesystem::path& file);
/// True for "-" and the names of standard output; other output of the command would be mixed with the content.
bool is_standard_output(const std::filesystem::path& file);

/// Reasons why `file`, given as `option`, cannot be written: it exists and may not be replaced, is not a regular file,
/// or its folder is missing or not writable. Call this before any simulation.
Faults output_file_faults(const std::string& option, const std::filesystem::path& file, bool force);
/// As `output_file_faults`, but streams are allowed.
Faults output_faults(const std::string& option, const std::filesystem::path& file, bool force);

/// Reasons why a folder, given as `option`, cannot be created or written. Creates nothing. Call this before any
/// simulation.
Faults output_folder_faults(const std::string& option, const std::filesystem::path& folder);

/// The folder as an absolute path, or its nearest existing parent.
std::filesystem::path nearest_there(std::filesystem::path folder);

/// Writes to a stream, or replaces a file (`write_atomically`).
Faults write_output(const std::filesystem::path& file, std::string_view content);

/// Prints a card as JSON or as `words`, and writes it to `out`, unless that is empty. Throws a `Refusal` if writing
/// fails.
void deliver_card(const Card& card, const std::string& words, bool json, const std::filesystem::path& out);

}  // namespace pastefit
