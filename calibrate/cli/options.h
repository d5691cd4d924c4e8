#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "calibrate/base/machine.h"
#include "calibrate/card/card.h"
#include "calibrate/cli/terminal.h"
#include "core/result.h"

namespace pastefit {

/// Validators of numeric options, applied before conversion: a single finite number in its range. The fault shows the
/// text, truncated if long, and the correct form.

/// Above 0 and at most 1e9, beyond any useful duration or size.
CLI::Validator positive_number();

CLI::Validator number_from(double smallest, double largest);

CLI::Validator whole_number(std::uint64_t smallest = 0,
                            std::uint64_t largest = std::numeric_limits<std::uint64_t>::max());

/// Fault of a command with an estimated run time of more than a day: at least `processor_s`, on `threads` threads (0:
/// one per processor). `work`: the cause, e.g. "7.6e+06 grains". Empty with `force`, and for shorter runs; above one
/// hour, a note with the estimate is printed to standard error.
Faults long_run_faults(const std::string& where, const std::string& work, double processor_s, int threads, bool force,
                       const std::string& remedy);

/// Fault of pictures that exceed the free disk space of a folder, which may not exist yet. Empty with `force`.
Faults picture_faults(const std::filesystem::path& folder, double pictures, double grains, bool force);

/// True for "-" and the names of standard output; other output of the command would be mixed with the content.
bool is_standard_output(const std::filesystem::path& file);

/// Reasons why `file`, given as `option`, cannot be written: it exists and may not be replaced, is not a regular file,
/// or its folder is missing or not writable. Call this before any simulation.
Faults output_file_faults(const std::string& option, const std::filesystem::path& file, bool force);
/// As `output_file_faults`, but streams are allowed: "-", names such as /dev/stdout, devices and FIFOs.
Faults output_faults(const std::string& option, const std::filesystem::path& file, bool force);

/// Reasons why a folder, given as `option`, cannot be created or written. Creates nothing. Call this before any
/// simulation.
Faults output_folder_faults(const std::string& option, const std::filesystem::path& folder);

/// Writes to a stream, or replaces a file (`write_atomically`).
Faults write_output(const std::filesystem::path& file, std::string_view content);

/// Prints a card as JSON or as `words`, and writes it to `out`, unless that is empty. Throws a `Refusal` if writing
/// fails.
void deliver_card(const Card& card, const std::string& words, bool json, const std::filesystem::path& out);

/// Adds --threads to a verb; numbers above the processor count are reduced to it, with a note.
inline void add_threads(CLI::App& verb, int& threads,
                        const std::string& meaning = "simulations at the same time; default: one for each processor") {
  verb.add_option("--threads", threads, meaning)
      ->type_name("N")
      ->transform(CLI::Validator(
          [](std::string& text) -> std::string {
            if (auto fault = whole_number(1, 1'000'000)(text); !fault.empty()) return fault;
            if (std::stoi(text) <= processors()) return {};
            const std::string here = std::to_string(processors());
            note("pastefit: --threads %s: this machine has %s processors: as many threads are used\n", text.c_str(),
                 here.c_str());
            text = here;
            return {};
          },
          ""));
}

}  // namespace pastefit
