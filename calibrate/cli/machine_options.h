#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "calibrate/base/machine.h"

namespace pastefit {

/// Adds --threads to a verb: from 1 to the processors of this machine.
inline void add_threads(CLI::App& verb, int& threads,
                        const std::string& meaning = "simulations at the same time; default: one for each processor") {
  verb.add_option("--threads", threads, meaning)
      ->type_name("N")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            int asked = 0;
            if (CLI::detail::lexical_cast(text, asked) && asked >= 1 && asked <= processors()) return {};
            return "is " + text + "; this machine has " + std::to_string(processors()) + " processors: give 1 to " +
                   std::to_string(processors()) + ", or leave it out";
          },
          ""));
}

}  // namespace pastefit
