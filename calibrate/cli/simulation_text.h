#pragma once

#include <map>
#include <string>
#include <string_view>

#include "calibrate/laboratory/test.h"
#include "core/observe/outline.h"
#include "core/step/run.h"

namespace pastefit {

/// What is said of one simulation. `wall_s`: what it took.

/// Readings and run as JSON text, with the yield stresses that the readings say (`test`: nothing for an impact).
/// `outlines`: of the heap, by name, written as the points of a profile in a laboratory
/// file: {"step1": [[x_mm, z_mm], ...], ...}.
std::string simulation_json(const Outcome& outcome, const Test* test,
                            const std::map<std::string_view, Outline>& outlines, double wall_s);

/// The same for people, without outlines. `packed`: it was of a random packing.
void print_simulation(const Outcome& outcome, double wall_s, bool packed);

/// One line for each point, below the names of the axes.
std::string csv_of(const Curve& curve);

/// Says on standard error whether the step that the user has set is a stable one.
void judge_step(double given_s, double advised_s);

/// Says on standard error why a simulation has no readings.
void print_failure(const Failure& failure);

}  // namespace pastefit
