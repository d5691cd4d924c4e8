#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "calibrate/card/card.h"
#include "core/result.h"

namespace pastefit {

/// True of "-", of what the system calls /dev/stdout and the like, and of devices and FIFOs: content goes there, and
/// nothing is replaced.
bool is_stream(const std::filesystem::path& file);
/// True of "-" and the names of standard output: what else the command prints would get in between.
bool is_standard_output(const std::filesystem::path& file);

/// What keeps `file`, given as `option`, from being written: it is there and may not be replaced, it is no regular
/// file, or its folder is not there or cannot be written. To be asked before anything runs.
Faults output_file_faults(const std::string& option, const std::filesystem::path& file, bool force);
/// The same where a stream will do, too.
Faults output_faults(const std::string& option, const std::filesystem::path& file, bool force);

/// What keeps a folder, given as `option`, from being made or written. To be asked before anything runs; nothing is
/// made.
Faults output_folder_faults(const std::string& option, const std::filesystem::path& folder);

/// The folder itself, absolute, or the nearest above it that is there.
std::filesystem::path nearest_there(std::filesystem::path folder);

/// Writes to a stream, or replaces the file (`write_atomically`).
Faults write_output(const std::filesystem::path& file, std::string_view content);

/// Prints a card, as it is stored or in `words`, and writes it to `out`, if that is not empty. Throws a `Refusal` if it
/// could not be written.
void deliver_card(const Card& card, const std::string& words, bool json, const std::filesystem::path& out);

}  // namespace pastefit
