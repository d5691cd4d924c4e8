#include "fix_hinge_pastefit.h"

#include <cmath>

#include "error.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace pastefit_lammps {

namespace {

constexpr double kGravity = 9.81;

}  // namespace

FixHingePastefit::FixHingePastefit(LAMMPS_NS::LAMMPS* lammps, int words, char** word) : Fix(lammps, words, word) {
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 0;
  if (words < 4) error->all(FLERR, std::string("fix hinge/pastefit: fix ID group hinge/pastefit WALL NAME VALUE ..."));
  wall_id_ = word[3];
  const std::string faults = read_hinge(std::vector<std::string>(word + 4, word + words), plate_);
  if (!faults.empty()) error->all(FLERR, "fix " + std::string(id) + " hinge/pastefit:" + faults);
  angle_ = plate_.angle_rad;
}

int FixHingePastefit::setmask() {
  return FixConst::INITIAL_INTEGRATE;
}

void FixHingePastefit::init() {
  const int wall = modify->find_fix(wall_id_);
  if (wall < 0) error->all(FLERR, "fix hinge/pastefit: there is no fix " + wall_id_);
  wall_ = modify->fix[wall];
}

/// The wall's torque is that of the last step, about the origin: moved to the hinge here.
void FixHingePastefit::initial_integrate(int) {
  if (angle_ >= 0) return;
  const double torque =
      wall_->compute_vector(4) - plate_.z_m * wall_->compute_vector(0) + plate_.x_m * wall_->compute_vector(2);
  const double weight = plate_.mass_kg * kGravity * plate_.arm_m * std::cos(angle_);
  turning_ += update->dt * (torque + weight) / plate_.inertia_kg_m2;
  angle_ += update->dt * turning_;
  if (angle_ >= 0) angle_ = turning_ = 0;
}

}  // namespace pastefit_lammps
