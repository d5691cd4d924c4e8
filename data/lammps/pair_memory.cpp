#include "pair_memory.h"

#include "atom.h"
#include "neigh_list.h"

using namespace LAMMPS_NS;

namespace pastefit_lammps {

int PairMemory::setmask() {
  return FixConst::PRE_EXCHANGE | FixConst::POST_NEIGHBOR | FixConst::POST_RUN;
}

void PairMemory::pre_exchange() {
  bring_up_to_date();
  announce_size();
}

/// With newton off the processor of the other grain has the pair as well, and keeps its own history of it.
void PairMemory::bring_up_to_date() {
  if (!ahead_) return;
  ahead_ = false;
  const tagint* id_of = atom->tag;
  for (auto& entries : of_grain_) entries.clear();
  for (int ii = 0; ii < list_->inum; ++ii) {
    const int i = list_->ilist[ii];
    for (int jj = 0; jj < list_->numneigh[i]; ++jj) {
      const ContactHistory& history = of_pair_[first_[ii] + static_cast<std::size_t>(jj)];
      if (history.empty()) continue;
      const int j = list_->firstneigh[i][jj] & NEIGHMASK;
      of_grain_[i].push_back({id_of[j], history});
      if (j < atom->nlocal) of_grain_[j].push_back({id_of[i], history.turned()});
    }
  }
}

void PairMemory::post_neighbor() {
  of_pair_.clear();
  first_.clear();
  for (int ii = 0; ii < list_->inum; ++ii) {
    const int i = list_->ilist[ii];
    first_.push_back(of_pair_.size());
    for (int jj = 0; jj < list_->numneigh[i]; ++jj) {
      of_pair_.emplace_back();
      const tagint other = atom->tag[list_->firstneigh[i][jj] & NEIGHMASK];
      for (const Entry& entry : of_grain_[i])
        if (entry.key == other) of_pair_.back() = entry.history;
    }
  }
  of_pair_.emplace_back();  // rows without neighbours begin somewhere, too
}

}  // namespace pastefit_lammps
