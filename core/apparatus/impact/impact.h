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

/// A grain of an impact at the start.
struct ImpactGrain {
  double radius_m = 0.01;
  Vec3 centre_m;
  Vec3 velocity_m_s;
  Vec3 spin_rad_s;
  bool held = false;                 ///< moves at its velocity regardless of forces, as in a testing machine; no spin
  std::optional<double> turns_at_s;  ///< held grains only: at this time the velocity is reversed
};

/// A wall of an impact and its motion.
struct ImpactWall {
  Shape shape;
  WallContact surface;
  Vec3 velocity_m_s;
  Vec3 hinge_m;              ///< rotation is about the y axis through this point
  double turning_rad_s = 0;  ///< about y; positive lowers the side at +x
  /// Plates only: the wall rotates freely about its hinge with this mass, driven by its weight and the grains; it stops
  /// dead when its centre is level with the hinge. Inertia M (L^2/12 + arm^2), i.e. M L^2/3 with the hinge at its edge.
  std::optional<double> rotor_mass_kg;
};

/// Choice of the time step.
enum class ImpactStep {
  per_contact,  ///< constant: `steps_per_contact` steps in the shortest Hertz collision at the fastest approach
  fixed,        ///< constant: `step_s`
  engine        ///< as in the other tests: follows from the scene
};

/// A collision of a few bodies, used to verify a contact law against a closed form.
///
/// All grains have the same material. Overlap, force and contact time are measured on the first grain. Up to about a
/// hundred bodies: all pairs are checked in every step.
struct Impact {
  ContactModel contact;
  double density_kg_m3 = 2500;
  double reference_radius_m = 0.01;  ///< grain size that the bridge constants refer to
  std::vector<ImpactGrain> grains;
  std::vector<ImpactWall> walls;
  double gravity_m_s2 = 0;  ///< along -z
  double duration_s = 0;
  /// If given, the run ends early once the first grain has touched something and then either has a larger gap than this
  /// to everything, or approaches again: its rebound is over.
  std::optional<double> rebound_gap_m;
  ImpactStep step = ImpactStep::per_contact;
  double steps_per_contact = 400;
  double step_s = 0;
  std::vector<double> pull_gaps_m;  ///< gaps of the first grain at which attraction is read; < 0: overlaps
};

/// Returns the reasons why the test cannot run, with their places, e.g. "grains[1].radius_m"; empty if it can.
Faults validate(const Impact& test);

/// Runs the impact. Velocities are read at the time of the positions (mean of the half steps before and after).
///
/// Readings, with i the index of a grain:
///   grain{i}.{position,velocity,spin}_{x,y,z}_{m,m_s,rad_s}, grain{i}.speed_m_s
/// First grain:
///   overlap_m             at the end
///   max_overlap_m
///   max_force_n           all forces except its weight
///   contact_time_s        total
///   pull{k}_n             attraction at the k-th of `pull_gaps_m`, at the last passage; absent if never passed
///   decay_rate_1_s        of its oscillation about the start, along its first velocity; absent unless it turned twice
///   rebound_top_m         highest z since first touch; absent without touch
/// First two grains:
///   relative_speed_m_s    of their centres
/// All:
///   kinetic_energy_ratio  end over start; absent for a start at rest
///   momentum_drift        momentum that no impulse explains (walls, gravity, holding), over the largest sum of m |v|
///   work_j                of the forces that hold grains
///   time_s
/// A rotor that reached its stop: `rotor_time_s`, `rotor_rad_s`. Requirement: `validate(test)` is empty.
Outcome simulate(const Impact& test, const RunOptions& options = {});

/// Mass of a grain of the test [kg].
double mass_kg(const Impact& test, const ImpactGrain& grain);

}  // namespace pastefit
