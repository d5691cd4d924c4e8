#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "core/result.h"

namespace pastefit {

/// Exit statuses of the program.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    ///< the run has no answer, or could not keep it
inline constexpr int kBadInput = 2;  ///< what the user gave cannot be used; nothing was written

/// A verb adds its options to the program and returns what runs it, with the exit status as answer.
using Command = std::function<int()>;
Command add_batch(CLI::App& verb);
Command add_calibrate(CLI::App& verb);
Command add_check(CLI::App& verb);
Command add_compare(CLI::App& verb);
Command add_confirm(CLI::App& verb);
Command add_export(CLI::App& verb);
Command add_help(CLI::App& verb);
Command add_infer(CLI::App& verb);
Command add_new(CLI::App& verb);
Command add_predict(CLI::App& verb);
Command add_read(CLI::App& verb);
Command add_report(CLI::App& verb);
Command add_rescale(CLI::App& verb);
Command add_show(CLI::App& verb);
Command add_simulate(CLI::App& verb);
Command add_template(CLI::App& verb);
Command add_verify(CLI::App& verb);

/// Prints every fault to standard error; returns `status`.
int report(const Faults& faults, int status = kBadInput);

}  // namespace pastefit
