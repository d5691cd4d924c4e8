#pragma once

namespace pastefit {

/// Energy balance of a run [J]. Dissipation and work are sums since the start of the run.
///
/// Balance: mechanical() - start = work_of_walls - dissipation(). The remainder, `error()`, is the integration error:
/// positive means that energy was created.
struct EnergyBalance {
  double kinetic = 0;  ///< translation and rotation, now
  double stored = 0;   ///< Hertz, tangential and rolling springs, minus the work living bridges can still do, now
  double height = 0;   ///< potential energy in gravity, now
  double start = 0;    ///< mechanical() at the start: such that the error is zero at the first evaluation
  double start_height = 0;
  double start_kinetic = 0;
  double start_elastic = 0;  ///< in overlaps, at the first evaluation
  double earlier_error = 0;  ///< of the preceding run, from whose final state this one started
  double earlier_put_in = 0;

  double dissipation_normal = 0;   ///< damping along the normal
  double dissipation_sliding = 0;  ///< friction and tangential damping
  double dissipation_rolling = 0;
  double dissipation_bridges = 0;  ///< work of separation of new bridges, and of new adhesive contacts
  double dissipation_viscous = 0;  ///< of the liquid between grains
  double dissipation_plastic = 0;  ///< by plastic deformation of contacts
  double dissipation_drag = 0;     ///< in phases with drag
  double work_of_walls = 0;        ///< on the grains
  double effort_of_walls = 0;      ///< sum of its absolute values

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kinetic, stored, height, start, start_height, start_kinetic, start_elastic, earlier_error, earlier_put_in);
    archive(dissipation_normal, dissipation_sliding, dissipation_rolling, dissipation_bridges, dissipation_viscous,
            dissipation_plastic, dissipation_drag, work_of_walls, effort_of_walls);
  }
  double mechanical() const { return kinetic + stored + height; }
  double dissipation() const {
    return dissipation_normal + dissipation_sliding + dissipation_rolling + dissipation_bridges + dissipation_viscous +
           dissipation_plastic + dissipation_drag;
  }
  double error() const { return mechanical() + dissipation() - start - work_of_walls + earlier_error; }
  /// Energy put in: fall, walls, speed and overlaps at the start, and attraction released by bridges.
  double put_in() const {
    const double fall = start_height > height ? start_height - height : 0;
    return fall + effort_of_walls + start_kinetic + start_elastic + dissipation_bridges + earlier_put_in;
  }
};

}  // namespace pastefit
