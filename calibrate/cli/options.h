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

/// Checks of the number behind an option, before it is read: no more and no less than a finite number in its range. The
/// fault says what stands there, cut if long, and what would be right.

/// Above 0, and no more than anyone could wait for or look at: 1e9.
CLI::Validator positive_number();

/// From `smallest` to `largest`.
CLI::Validator number_from(double smallest, double largest);

/// A whole number without sign, from `smallest` to `largest`.
CLI::Validator whole_number(std::uint64_t smallest = 0,
                            std::uint64_t largest = std::numeric_limits<std::uint64_t>::max());

/// The fault of a command that would compute for more than a day: `processor_s` at least, on so many threads (0: one
/// for each processor). `work`: what takes it, e.g. "7.6e+06 grains". Empty with `force`, and where it takes no more;
/// what takes more than an hour is then said on standard error.
Faults long_run_faults(const std::string& where, const std::string& work, double processor_s, int threads, bool force,
                       const std::string& remedy);

/// The fault of pictures that do not fit on the disk of a folder, which need not be there yet. Empty with `force`.
Faults picture_faults(const std::filesystem::path& folder, double pictures, double grains, bool force);

/// Adds --threads to a verb; more than this machine has processors are as many as that, with a word.
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
