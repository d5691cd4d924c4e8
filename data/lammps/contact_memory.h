#pragma once

#include <vector>

#include "fix.h"
#include "surfaces.h"

namespace pastefit_lammps {

/// What grains remember of their contacts, kept with each grain: it moves to another processor, and into restart files,
/// with it. Each history has a key: the ID of the other grain, or the number of the wall's face.
class ContactMemory : public LAMMPS_NS::Fix {
 public:
  ContactMemory(LAMMPS_NS::LAMMPS* lammps, int words, char** word);
  ~ContactMemory() override;

  void grow_arrays(int count) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int grain) override;
  int pack_exchange(int grain, double* buffer) override;
  int unpack_exchange(int grain, double* buffer) override;
  int pack_restart(int grain, double* buffer) override;
  void unpack_restart(int grain, int nth) override;
  int size_restart(int grain) override;
  int maxsize_restart() override;
  double memory_usage() override;

 protected:
  struct Entry {
    LAMMPS_NS::tagint key;
    History history;
  };
  /// Called before the entries are read.
  virtual void bring_up_to_date() {}
  /// Tells the communication how much a grain may bring along.
  void announce_size();

  std::vector<std::vector<Entry>> of_grain_;

 private:
  static constexpr int kEntrySize = 1 + kHistoryNumbers;
};

/// The history of grains' contacts with each other: one for each pair of the neighbour list while a list lasts, kept
/// with the grains from one list to the next. Pair style pastefit makes it; nobody names it in a script.
class PairMemory : public ContactMemory {
 public:
  static constexpr const char* kStyle = "PASTEFIT/MEMORY";
  using ContactMemory::ContactMemory;

  int setmask() override;
  void setup_pre_exchange() override { pre_exchange(); }
  void pre_exchange() override;
  void setup_post_neighbor() override { post_neighbor(); }
  void post_neighbor() override;
  void post_run() override { bring_up_to_date(); }

  void follow(const LAMMPS_NS::NeighList* list) { list_ = list; }
  /// Memories of the pairs of the ii-th row of the list, in the order of its neighbours; whoever asks may change them.
  History* row(int ii) {
    ahead_ = true;
    return &of_pair_[first_[ii]];
  }

 private:
  void bring_up_to_date() override;

  const LAMMPS_NS::NeighList* list_ = nullptr;
  std::vector<History> of_pair_;
  std::vector<std::size_t> first_;  ///< of each row
  bool ahead_ = false;              ///< pairs know more than the grains' entries
};

}  // namespace pastefit_lammps
