#pragma once

#include "contact_memory.h"

namespace LAMMPS_NS {
class Region;
}

namespace pastefit_lammps {

/// fix ID group wall/pastefit REGION NAME VALUE ...      the wall's own law, names as of a wall on a card
///
/// The surface of a region as a wall, by the law of pair style pastefit; the region may move and turn, and may have
/// open faces. A wall carries no liquid shell: a bridge to it forms at the offset of one grain. The fix's vector is
/// force and torque, about the origin, of the grains on the wall [N, N m].
class FixWallPastefit : public ContactMemory {
 public:
  static constexpr const char* kStyle = "wall/pastefit";
  FixWallPastefit(LAMMPS_NS::LAMMPS* lammps, int words, char** word);

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override { announce_size(); }
  void pre_exchange() override { announce_size(); }
  void setup(int vflag) override { post_force(vflag); }
  void post_force(int) override;
  double compute_vector(int component) override;

 private:
  void meet(int grain, int contact, bool stands, History& history);
  /// The entry of a face of the wall, found or new, moved to place `n` of the grain's entries.
  History& entry(int grain, std::size_t n, int face);

  std::string region_id_;
  LAMMPS_NS::Region* region_ = nullptr;
  pastefit::WallContact wall_;
  Surfaces surfaces_;
  double load_[6] = {};  ///< of this processor's grains on the wall
};

}  // namespace pastefit_lammps
