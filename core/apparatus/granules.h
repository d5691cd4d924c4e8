#pragma once

#include <functional>
#include <optional>

#include "core/apparatus/field_checker.h"
#include "core/apparatus/specimen.h"
#include "core/step/runner.h"

namespace pastefit {

// Shared by the tests of small cohesive granules (core/apparatus/pellet_crush, core/apparatus/shear_cell).

/// Granules in a vessel, struck off and at rest; or the reason why filling failed.
struct FilledVessel {
  LooseGrains grains;
  RunSummary run;
  std::optional<Failure> failure;
  EnergyBalance fall;  ///< work of gravity, the only drive of the filling; its dissipation is not tracked
};

/// Builds the world of an empty vessel around these granules.
using Vessel = std::function<World(const LooseGrains&)>;

/// Filling of a vessel.
struct Pouring {
  double height_m = 0;        ///< at which the granules are struck off
  double pour_speed_m_s = 1;  ///< at which granules arrive
};

/// Fills a vessel under the test's own laws: the density of cohesive granules follows from their cohesion and their
/// arrival speed. They sink as in a liquid. Those above the fill height are removed, and the rest settles again.
/// `loose`: more granules than needed, stacked above each other.
FilledVessel fill_vessel(const Specimen& granules, const Pouring& pouring, const LooseGrains& loose,
                         const Vessel& vessel, const RestMeasure& rest_measure, const RunOptions& options);

/// Failure: less than `emptiest` of the vessel is solid.
Failure bridged(const FilledVessel& filled, double solid_fraction, double emptiest);

/// Run options for small granules. Criterion of rest: the default window suits grains of 8 mm and is scaled by the time
/// of a fall by one radius. A strong bed oscillates for long, at speeds far below those of the tools, so the speed
/// limit is three times the default and the limit of change five times. Overlap limit: soft granules under pressure
/// overlap more than in a heap, and recover.
RunOptions with_bounds_of(const Specimen& granules, RunOptions options);

/// Solid volume poured into a vessel of this volume [m^3]; the excess is struck off.
double poured_volume_m3(double vessel_m3);

/// Number of granules of this solid volume, from the mean of a thousand.
double number_of_granules(const Specimen& granules, double solid_m3);

/// Speed of sound in a bed of these granules [m/s]: that of a row of equal granules that overlap by 1 % of their
/// diameter, 2 R sqrt(S_n/m) with S_n = 2 E* a, a^2 = R* d. It is lower in a loose bed and higher under pressure.
double sound_speed_m_s(const Specimen& granules);

/// Adds a fault if a tool moves faster than a tenth of that speed, where it would throw granules. Skipped if the
/// granules have faults themselves.
void check_speed(FieldChecker& check, const Specimen& granules, const char* where, const char* tool, double speed_m_s,
                 const char* remedy);

/// Adds the cost of an earlier phase.
void add_work(RunSummary& sum, const RunSummary& part);

}  // namespace pastefit
