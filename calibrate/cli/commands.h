#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "calibrate/base/refusal.h"

namespace pastefit {

/// Exit status of the program; others are in `Refusal`.
inline constexpr int kDone = 0;

/// Adds the options of a verb and returns the function that runs it, whose result is the exit status. A thrown
/// `Refusal` is printed to standard error.
using Command = std::function<int()>;
Command add_batch(CLI::App& verb);
Command add_calibrate(CLI::App& verb);
Command add_check(CLI::App& verb);
Command add_compare(CLI::App& verb);
Command add_confirm(CLI::App& verb);
Command add_doctor(CLI::App& verb);
Command add_export(CLI::App& verb);
Command add_help(CLI::App& verb);
Command add_infer(CLI::App& verb);
Command add_kpi(CLI::App& verb);
Command add_new(CLI::App& verb);
Command add_plan(CLI::App& verb);
Command add_predict(CLI::App& verb);
Command add_read(CLI::App& verb);
Command add_report(CLI::App& verb);
Command add_rescale(CLI::App& verb);
Command add_show(CLI::App& verb);
Command add_simulate(CLI::App& verb);
Command add_template(CLI::App& verb);
Command add_verify(CLI::App& verb);

}  // namespace pastefit
