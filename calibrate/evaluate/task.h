#pragma once

#include <string>

#include "calibrate/laboratory/sketch.h"
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

/// Content of an answer.
struct TaskAnswer {
  Outcome outcome;
  Sketch sketch;      ///< no points: none
  double wall_s = 0;  ///< wall time of the simulation
};

/// Reads an answer; empty text: stopped. Errors: throws for text that the functions above do not write.
TaskAnswer answer_of_task(const std::string& answer);

}  // namespace pastefit
