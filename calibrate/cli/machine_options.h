#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "calibrate/base/machine.h"
#include "calibrate/cli/option_checks.h"
#include "calibrate/cli/standard_output.h"

namespace pastefit {

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
