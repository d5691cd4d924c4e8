#include "pair_pastefit.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "comm.h"
#include "contact_memory.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace pastefit_lammps {

namespace {

const char* const kMemoryId = "pastefit_memory";

}  // namespace

PairPastefit::PairPastefit(LAMMPS_NS::LAMMPS* lammps) : Pair(lammps) {
  single_enable = 0;
  restartinfo = 0;
  one_coeff = 1;
  no_virial_fdotr_compute = 1;
  finitecutflag = 1;
}

PairPastefit::~PairPastefit() {
  if (memory_ && modify->find_fix(kMemoryId) >= 0) modify->delete_fix(kMemoryId);
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairPastefit::settings(int words, char** word) {
  const std::string faults = read_law(std::vector<std::string>(word, word + words), law_);
  if (!faults.empty()) error->all(FLERR, "pair_style pastefit:" + faults);
  surfaces_ = Surfaces(law_);
}

void PairPastefit::coeff(int words, char** word) {
  if (words != 2 || std::string(word[0]) != "*" || std::string(word[1]) != "*")
    error->all(FLERR, std::string("pair style pastefit has one law for all grains: pair_coeff * *"));
  const int types = atom->ntypes + 1;
  if (!allocated) {
    memory->create(setflag, types, types, "pair:setflag");
    memory->create(cutsq, types, types, "pair:cutsq");
    allocated = 1;
  }
  for (int i = 1; i < types; ++i)
    for (int j = 1; j < types; ++j) setflag[i][j] = 1;
}

void PairPastefit::init_style() {
  std::string faults;
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag) faults += "\n  atom_style sphere";
  if (!atom->tag_enable) faults += "\n  grains with IDs";
  if (force->newton_pair) faults += "\n  newton off";
  if (!comm->ghost_velocity) faults += "\n  comm_modify vel yes";
  if (!faults.empty()) error->all(FLERR, "pair style pastefit needs" + faults);

  std::vector<double> own(static_cast<std::size_t>(atom->ntypes) + 1);
  for (int i = 0; i < atom->nlocal; ++i) own[atom->type[i]] = std::max(own[atom->type[i]], atom->radius[i]);
  largest_.resize(own.size());
  MPI_Allreduce(own.data(), largest_.data(), static_cast<int>(own.size()), MPI_DOUBLE, MPI_MAX, world);

  neighbor->request(this, instance_me);
  if (!memory_)
    memory_ = static_cast<PairMemory*>(modify->add_fix(std::string(kMemoryId) + " all " + PairMemory::kStyle));
}

void PairPastefit::init_list(int id, NeighList* made) {
  Pair::init_list(id, made);
  memory_->follow(made);
}

double PairPastefit::init_one(int first, int second) {
  const double a = largest_[first], b = largest_[second];
  return a + b > 0 ? a + b + surfaces_.reach(a * b / (a + b)) : surfaces_.reach(law_.reference_radius_m / 2);
}

void PairPastefit::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const double dt = update->dt;
  const bool stands = update->setupflag;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    const Vec3 at = vector(atom->x[i]);
    const double radius = atom->radius[i];
    History* memories = memory_->row(ii);
    for (int jj = 0; jj < list->numneigh[i]; ++jj) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const Vec3 between = vector(atom->x[j]) - at;
      const double other = atom->radius[j];
      Meeting m;
      m.radius = radius * other / (radius + other);
      const double square = dot(between, between), farthest = radius + other + surfaces_.reach(m.radius);
      if (square > farthest * farthest) {
        memories[jj] = {};
        continue;
      }
      const double distance = std::sqrt(square);
      m.normal = 1 / distance * between;
      m.overlap = radius + other - distance;
      const double half_depth = 0.5 * m.overlap;  // or, below zero, of the gap: lubrication acts in its middle
      const double lever_i = radius - half_depth, lever_j = other - half_depth;
      const Vec3 spin_i = vector(atom->omega[i]), spin_j = vector(atom->omega[j]);
      m.velocity = vector(atom->v[i]) - vector(atom->v[j]) + cross(lever_i * spin_i + lever_j * spin_j, m.normal);
      m.spin = spin_i - spin_j;
      m.twist = 0.5 * dot(spin_i + spin_j, m.normal);
      m.mass = atom->rmass[i] * atom->rmass[j] / (atom->rmass[i] + atom->rmass[j]);
      m.smaller_radius = std::min(radius, other);
      const Reaction reaction = surfaces_.act(m, memories[jj], dt, stands);
      const Vec3 turning = cross(m.normal, reaction.tangential_force);
      add(atom->f[i], reaction.force);
      add(atom->torque[i], lever_i * turning + reaction.moment);
      if (j < atom->nlocal) {
        add(atom->f[j], -1.0 * reaction.force);
        add(atom->torque[j], lever_j * turning - reaction.moment);
      }
      if (evflag)
        ev_tally_xyz(i, j, atom->nlocal, 0, 0, 0, reaction.force.x, reaction.force.y, reaction.force.z, -between.x,
                     -between.y, -between.z);
    }
  }
}

}  // namespace pastefit_lammps
