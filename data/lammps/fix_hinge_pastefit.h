#pragma once

#include "fix.h"
#include "surfaces.h"

namespace pastefit_lammps {

/// fix ID group hinge/pastefit WALL NAME VALUE ...      the plate, `Hinge` has the names
///
/// A rigid plate that falls under its own weight, along -z, and the grains on it: I dw/dt = torque of the grains + m g
/// arm cos(angle). Fix WALL (wall/pastefit) is its surface. It is stopped dead where it is level. The fix's scalar is
/// the angle [rad]: a region that is the plate says "rotate v_angle ...", with "variable angle equal f_ID".
class FixHingePastefit : public LAMMPS_NS::Fix {
 public:
  static constexpr const char* kStyle = "hinge/pastefit";
  FixHingePastefit(LAMMPS_NS::LAMMPS* lammps, int words, char** word);

  int setmask() override;
  void init() override;
  void initial_integrate(int) override;
  double compute_scalar() override { return angle_; }

 private:
  std::string wall_id_;
  LAMMPS_NS::Fix* wall_ = nullptr;
  Hinge plate_;
  double angle_ = 0, turning_ = 0;  ///< [rad, rad/s]; positive lowers the free edge
};

}  // namespace pastefit_lammps
