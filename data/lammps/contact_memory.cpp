#include "contact_memory.h"

#include <algorithm>
#include <cstring>

#include "atom.h"
#include "neigh_list.h"

using namespace LAMMPS_NS;

namespace pastefit_lammps {

ContactMemory::ContactMemory(LAMMPS_NS::LAMMPS* lammps, int words, char** word) : Fix(lammps, words, word) {
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange_dynamic = 1;
  maxexchange = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

ContactMemory::~ContactMemory() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

void ContactMemory::grow_arrays(int count) {
  of_grain_.resize(static_cast<std::size_t>(count));
}

void ContactMemory::copy_arrays(int from, int to, int) {
  of_grain_[to] = of_grain_[from];
}

void ContactMemory::set_arrays(int grain) {
  of_grain_[grain].clear();
}

void ContactMemory::announce_size() {
  std::size_t most = 0;
  for (int i = 0; i < atom->nlocal; ++i) most = std::max(most, of_grain_[i].size());
  maxexchange = 1 + kEntrySize * static_cast<int>(most);
}

int ContactMemory::pack_exchange(int grain, double* buffer) {
  const auto& entries = of_grain_[grain];
  int n = 0;
  buffer[n++] = static_cast<double>(entries.size());
  for (const Entry& entry : entries) {
    buffer[n++] = static_cast<double>(entry.key);
    std::memcpy(buffer + n, &entry.history, sizeof entry.history);
    n += kHistoryNumbers;
  }
  return n;
}

int ContactMemory::unpack_exchange(int grain, double* buffer) {
  auto& entries = of_grain_[grain];
  int n = 0;
  entries.resize(static_cast<std::size_t>(buffer[n++]));
  for (Entry& entry : entries) {
    entry.key = static_cast<tagint>(buffer[n++]);
    std::memcpy(static_cast<void*>(&entry.history), buffer + n, sizeof entry.history);
    n += kHistoryNumbers;
  }
  return n;
}

int ContactMemory::size_restart(int grain) {
  bring_up_to_date();
  return 2 + kEntrySize * static_cast<int>(of_grain_[grain].size());
}

int ContactMemory::maxsize_restart() {
  bring_up_to_date();
  announce_size();
  return maxexchange + 1;
}

int ContactMemory::pack_restart(int grain, double* buffer) {
  bring_up_to_date();
  buffer[0] = size_restart(grain);
  pack_exchange(grain, buffer + 1);
  return size_restart(grain);
}

void ContactMemory::unpack_restart(int grain, int nth) {
  double* values = atom->extra[grain];
  int at = 0;
  for (int i = 0; i < nth; ++i) at += static_cast<int>(values[at]);
  unpack_exchange(grain, values + at + 1);
}

double ContactMemory::memory_usage() {
  double bytes = static_cast<double>(of_grain_.capacity() * sizeof(std::vector<Entry>));
  for (const auto& entries : of_grain_) bytes += static_cast<double>(entries.capacity() * sizeof(Entry));
  return bytes;
}

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
      const History& history = of_pair_[first_[ii] + static_cast<std::size_t>(jj)];
      if (is_empty(history)) continue;
      const int j = list_->firstneigh[i][jj] & NEIGHMASK;
      of_grain_[i].push_back({id_of[j], history});
      if (j < atom->nlocal) of_grain_[j].push_back({id_of[i], turned(history)});
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
