#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/laws/materials.h"
#include "core/result.h"
#include "core/step/run.h"
#include "core/vec3.h"
#include "core/world/walls.h"

namespace pastefit {

/// A grain of an impact, as it is at the start.
struct ImpactGrain {
  double radius_m = 0.01;
  Vec3 centre_m;
  Vec3 velocity_m_s;
  Vec3 spin_rad_s;
  bool held = false;  ///< moves as its velocity says whatever acts on it, like a grain in a testing machine; no spin
  std::optional<double> turns_at_s;  ///< held only: at this time the velocity changes its sign
};

/// A wall of an impact: what it is, and how it moves.
struct ImpactWall {
  Shape shape;
  WallContact surface;
  Vec3 velocity_m_s;
  Vec3 hinge_m;              ///< turning is about the y axis through this point
  double turning_rad_s = 0;  ///< about y; positive lowers what lies in +x
  /// Plates only: the wall is a free rotor of this mass about its hinge, driven by its weight and by the grains; it is
  /// stopped dead when its centre is level with the hinge. Inertia M (L^2/12 + arm^2): M L^2/3 with the hinge at its
  /// edge.
  std::optional<double> rotor_mass_kg;
};

/// How the time step of an impact is chosen.
enum class ImpactStep {
  per_contact,  ///< constant: `steps_per_contact` steps in the shortest Hertz collision at the fastest approach
  fixed,        ///< constant: `step_s`
  engine        ///< as in every other apparatus: it follows from the scene
};

/// A few bodies that meet: the experiment by which a contact law is checked against a closed form.
///
/// Grains share one material. The first grain is the one that is watched: overlap, force and contact time are its own.
/// A few bodies means up to some hundred: all pairs are looked at in every step.
struct Impact {
  ContactModel contact;
  double density_kg_m3 = 2500;
  double reference_radius_m = 0.01;  ///< size the bridge's numbers belong to
  std::vector<ImpactGrain> grains;
  std::vector<ImpactWall> walls;
  double gravity_m_s2 = 0;  ///< along -z
  double duration_s = 0;
  /// Given: the run ends sooner, when the first grain has touched something and is farther from everything than this
  /// gap, or comes near again: its rebound is over.
  std::optional<double> rebound_gap_m;
  ImpactStep step = ImpactStep::per_contact;
  double steps_per_contact = 400;
  double step_s = 0;
  std::vector<double> pull_gaps_m;  ///< gaps of the first grain at which the attraction on it is read; < 0: overlaps
};

/// Every reason why the test cannot be run, with its place, e.g. "grains[1].radius_m".
Faults validate(const Impact& test);

/// Runs the impact. Velocities are read at the same moment as positions (the mean of the half steps before and after).
///
/// Readings, i the index of a grain: `grain{i}.{position,velocity,spin}_{x,y,z}_{m,m_s,rad_s}`,
/// `grain{i}.speed_m_s`; of the first grain: `overlap_m` (at the end), `max_overlap_m`, `max_force_n` (all but its
/// weight), `contact_time_s` (in all), `pull{k}_n` (attraction at the k-th of `pull_gaps_m`, the last time the gap had
/// this value; absent if it never had), `decay_rate_1_s` (of its swing about where it started, along its first
/// velocity; absent if it did not turn twice), `rebound_top_m` (its highest z since it first touched; absent if it
/// never did); of the first two: `relative_speed_m_s` (of their centres); of all:
/// `kinetic_energy_ratio` (end over start; absent for a start at rest), `momentum_drift` (what the impulses of walls,
/// weight and hands leave unexplained, over the sum of m |v| at its largest), `work_j` (of the hands that hold grains),
/// `time_s`; of a rotor that reached its stop: `rotor_time_s`, `rotor_rad_s`. Requirement: `validate(test)` is empty.
Outcome simulate(const Impact& test, const RunOptions& options = {});

/// Mass of a grain of the test [kg].
double mass_kg(const Impact& test, const ImpactGrain& grain);

}  // namespace pastefit
