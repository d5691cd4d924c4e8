#pragma once

#include "pair.h"
#include "surfaces.h"

namespace pastefit_lammps {

class PairMemory;

/// pair_style pastefit NAME VALUE ...      the law, names and numbers of `test.contact` on a card
/// pair_coeff * *
///
/// One law for all grains; sizes may differ. Requirements: atom_style sphere, newton off, comm_modify vel yes, grains
/// with IDs.
class PairPastefit : public LAMMPS_NS::Pair {
 public:
  static constexpr const char* kStyle = "pastefit";
  explicit PairPastefit(LAMMPS_NS::LAMMPS* lammps);
  ~PairPastefit() override;

  void settings(int words, char** word) override;
  void coeff(int words, char** word) override;
  void init_style() override;
  void init_list(int id, LAMMPS_NS::NeighList* made) override;
  double init_one(int first, int second) override;
  void compute(int eflag, int vflag) override;

  const Law& law() const { return law_; }

 private:
  Law law_;
  Surfaces surfaces_;
  PairMemory* memory_ = nullptr;
  std::vector<double> largest_;  ///< radius of each type of grains [m]
};

}  // namespace pastefit_lammps
