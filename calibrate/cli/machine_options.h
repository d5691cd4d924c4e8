#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "calibrate/base/fault_text.h"
#include "calibrate/base/machine.h"
#include "calibrate/cli/option_checks.h"

namespace pastefit {

/// Adds --threads to a verb: from 1 to the processors of this machine.
inline void add_threads(CLI::App& verb, int& threads,
                        const std::string& meaning = "simulations at the same time; default: one for each processor") {
  verb.add_option("--threads", threads, meaning)
      ->type_name("N")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            if (whole_number(1, static_cast<std::uint64_t>(processors()))(text).empty()) return {};
            return "is " + in_quotes(text) + "; this machine has " + std::to_string(processors()) +
                   " processors: give 1 to " + std::to_string(processors()) + ", or leave it out";
          },
          ""));
}

}  // namespace pastefit
