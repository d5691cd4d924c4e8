#include "fix_wall_pastefit.h"

#include <algorithm>

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "pair_pastefit.h"
#include "region.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace pastefit_lammps {

FixWallPastefit::FixWallPastefit(LAMMPS_NS::LAMMPS* lammps, int words, char** word)
    : ContactMemory(lammps, words, word) {
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 1;
  if (words < 4) error->all(FLERR, std::string("fix wall/pastefit: fix ID group wall/pastefit REGION NAME VALUE ..."));
  region_id_ = word[3];
  const std::string faults = read_wall(std::vector<std::string>(word + 4, word + words), wall_);
  if (!faults.empty()) error->all(FLERR, "fix " + std::string(id) + " wall/pastefit:" + faults);
}

int FixWallPastefit::setmask() {
  return FixConst::PRE_EXCHANGE | FixConst::POST_FORCE;
}

void FixWallPastefit::init() {
  const int region = domain->find_region(region_id_);
  if (region < 0) error->all(FLERR, "fix wall/pastefit: there is no region " + region_id_);
  region_ = domain->regions[region];
  const auto* pair = dynamic_cast<PairPastefit*>(force->pair_match(PairPastefit::kStyle, 1, 0));
  if (!pair) error->all(FLERR, std::string("fix wall/pastefit needs pair style pastefit, whose law it takes"));
  surfaces_ = Surfaces(pair->law(), wall_);
}

void FixWallPastefit::post_force(int) {
  const bool stands = update->setupflag;
  std::fill(load_, load_ + 6, 0.0);
  region_->prematch();
  if (region_->dynamic_check()) region_->set_velocity();
  for (int i = 0; i < atom->nlocal; ++i) {
    auto& entries = of_grain_[i];
    const double radius = atom->radius[i], *at = atom->x[i];
    const int near =
        atom->mask[i] & groupbit ? region_->surface(at[0], at[1], at[2], radius + surfaces_.reach(radius)) : 0;
    for (int n = 0; n < near; ++n) meet(i, n, stands, entry(i, static_cast<std::size_t>(n), region_->contact[n].iwall));
    entries.resize(static_cast<std::size_t>(near));
  }
}

History& FixWallPastefit::entry(int grain, std::size_t n, int face) {
  auto& entries = of_grain_[grain];
  const auto found = std::find_if(entries.begin() + static_cast<std::ptrdiff_t>(std::min(n, entries.size())),
                                  entries.end(), [&](const Entry& one) { return one.key == face; });
  if (found == entries.end()) {
    entries.insert(entries.begin() + static_cast<std::ptrdiff_t>(n), Entry{face, {}});
  } else {
    std::swap(*found, entries[n]);
  }
  return entries[n].history;
}

void FixWallPastefit::meet(int i, int n, bool stands, History& history) {
  const auto& contact = region_->contact[n];
  if (contact.r <= 0) error->one(FLERR, std::string("fix wall/pastefit: a grain's centre lies in the wall"));
  const Vec3 to_wall = {-contact.delx, -contact.dely, -contact.delz};
  double wall_velocity[3] = {0, 0, 0};
  if (region_->dynamic_check()) region_->velocity_contact(wall_velocity, atom->x[i], n);
  Meeting m;
  m.normal = 1 / contact.r * to_wall;
  m.smaller_radius = m.radius = atom->radius[i];
  m.mass = atom->rmass[i];
  m.overlap = m.radius - contact.r;
  const double lever = m.radius - m.overlap;
  m.spin = vector(atom->omega[i]);
  m.velocity = vector(atom->v[i]) - vector(wall_velocity) + cross(lever * m.spin, m.normal);
  m.twist = 0.5 * dot(m.spin, m.normal);
  const Reaction reaction = surfaces_.act(m, history, update->dt, stands);
  add(atom->f[i], reaction.force);
  add(atom->torque[i], lever * cross(m.normal, reaction.tangential_force) + reaction.moment);
  add(load_, -1.0 * reaction.force);
  add(load_ + 3, -1.0 * cross(vector(atom->x[i]) + to_wall, reaction.force) - reaction.moment);
}

double FixWallPastefit::compute_vector(int component) {
  double sum = 0;
  MPI_Allreduce(&load_[component], &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

}  // namespace pastefit_lammps
