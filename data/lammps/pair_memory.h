#pragma once

#include "contact_memory.h"

namespace pastefit_lammps {

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
  ContactHistory* row(int ii) {
    ahead_ = true;
    return &of_pair_[first_[ii]];
  }

 private:
  void bring_up_to_date() override;

  const LAMMPS_NS::NeighList* list_ = nullptr;
  std::vector<ContactHistory> of_pair_;
  std::vector<std::size_t> first_;  ///< of each row
  bool ahead_ = false;              ///< pairs know more than the grains' entries
};

}  // namespace pastefit_lammps
