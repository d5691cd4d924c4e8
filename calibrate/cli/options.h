#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "calibrate/base/machine.h"
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
