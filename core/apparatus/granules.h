#pragma once

#include <functional>
#include <optional>

#include "core/apparatus/field_checker.h"
#include "core/apparatus/specimen.h"
#include "core/step/runner.h"

namespace pastefit {

// What tests of small granules that stick have in common (core/apparatus/pellet_crush, core/apparatus/shear_cell).

/// Granules in a vessel, struck off level and at rest; or why it could not be filled.
struct FilledVessel {
  LooseGrains grains;
  RunSummary run;
  std::optional<Failure> failure;
  EnergyBalance fall;  ///< of the granules, by which alone the filling was driven; what it turned into is not counted
};

/// An empty vessel: makes the world that these granules are put into.
using Vessel = std::function<World(const LooseGrains&)>;

/// How a vessel is filled.
struct Pouring {
  double height_m = 0;        ///< to which it is filled and struck off
  double pour_speed_m_s = 1;  ///< at which granules arrive
};

/// Fills a vessel under the test's own laws: how densely granules that stick come to lie follows from how much they
/// stick and how fast they arrive. They sink as in a liquid; what lies above the fill height is scraped away, and the
/// rest closes up where its neighbours are gone. `loose`: more than enough of them, above each other.
FilledVessel fill_vessel(const Specimen& granules, const Pouring& pouring, const LooseGrains& loose,
                         const Vessel& vessel, const RestMeasure& rest_measure, const RunOptions& options);

/// The run failed because less than `emptiest` of the vessel is solid.
Failure bridged(const FilledVessel& filled, double solid_fraction, double emptiest);

/// How granules are stepped. When they count as at rest: the usual window is for grains of 8 mm, and goes with the time
/// in which one falls by its radius; a strong bed swings for long like a jelly, at speeds far below those of the tools,
/// so what is slow is three times as fast as usual, and what changes little five times as much. How deep two may
/// overlap: where soft ones are pressed, single ones go deeper than in a heap, and still come back.
RunOptions with_bounds_of(const Specimen& granules, RunOptions options);

/// The solid volume that is poured into a vessel of this volume [m^3]; what does not fit is scraped away.
double poured_volume_m3(double vessel_m3);

/// Number of granules of this solid volume, by the mean of a thousand.
double number_of_granules(const Specimen& granules, double solid_m3);

/// Speed of sound in a bed of these granules [m/s]: of a row of equal ones that overlap by a hundredth of their
/// diameter, 2 R sqrt(S_n/m) with S_n = 2 E* a, a^2 = R* d. A loose bed is slower, a pressed one faster.
double sound_speed_m_s(const Specimen& granules);

/// A fault if a tool moves faster than a tenth of that speed: it would throw granules. None where the granules have
/// faults of their own.
void check_speed(FieldChecker& check, const Specimen& granules, const char* where, const char* tool, double speed_m_s,
                 const char* remedy);

/// Adds what a phase before this one has cost.
void add_work(RunSummary& sum, const RunSummary& part);

}  // namespace pastefit
