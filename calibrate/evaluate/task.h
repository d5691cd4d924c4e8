#pragma once

#include <string>

#include "calibrate/laboratory/test.h"
#include "core/step/run.h"

namespace pastefit {

// A simulation that another process runs, as JSON text, and its answer.

/// Everything that the simulation depends on. `packing`: name of the prepared packing; tasks with the same one share
/// it.
std::string task_text(const Test& test, const RunOptions& options, const std::string& packing);

/// Runs a task; returns the answer. This process keeps the packings of its latest tasks, each filled once. Thread-safe.
/// Errors: throws `Refusal` or nlohmann::json::exception for text that `task_text` does not write.
std::string simulate_task(const std::string& task);

/// Answer of a task that could not be run.
std::string failed_task(const std::string& message);

/// Outcome from an answer; empty text: stopped. Errors: throws for text that the functions above do not write.
Outcome outcome_of_task(const std::string& answer);

}  // namespace pastefit
