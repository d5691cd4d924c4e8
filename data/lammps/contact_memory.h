#pragma once

#include <vector>

#include "contact_law.h"
#include "fix.h"

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
    ContactHistory history;
  };
  /// Called before the entries are read.
  virtual void bring_up_to_date() {}
  /// Tells the communication how much a grain may bring along.
  void announce_size();

  std::vector<std::vector<Entry>> of_grain_;

 private:
  static constexpr int kEntrySize = 1 + ContactHistory::size;
};

}  // namespace pastefit_lammps
