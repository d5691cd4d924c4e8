// LAMMPS with the contact laws of pastefit: takes the same scripts and options as lmp.
// The styles are added before the script is read; its command "clear" forgets them.

#include <mpi.h>

#include <cstdio>

#include "contact_memory.h"
#include "fix_hinge_pastefit.h"
#include "fix_wall_pastefit.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "pair_pastefit.h"

using namespace pastefit_lammps;

namespace {

template <class Style>
LAMMPS_NS::Pair* new_pair(LAMMPS_NS::LAMMPS* lammps) {
  return new Style(lammps);
}

template <class Style>
LAMMPS_NS::Fix* new_fix(LAMMPS_NS::LAMMPS* lammps, int words, char** word) {
  return new Style(lammps, words, word);
}

constexpr int kLammps = 20210929;

/// Of the words that pair style and fix understand; decks look for it as variable pastefit_style.
const char* const kStyleVersion = "variable pastefit_style equal 2";

void add_styles(LAMMPS_NS::LAMMPS& lammps) {
  (*lammps.force->pair_map)[PairPastefit::kStyle] = &new_pair<PairPastefit>;
  (*lammps.modify->fix_map)[PairMemory::kStyle] = &new_fix<PairMemory>;
  (*lammps.modify->fix_map)[FixHingePastefit::kStyle] = &new_fix<FixHingePastefit>;
  (*lammps.modify->fix_map)[FixWallPastefit::kStyle] = &new_fix<FixWallPastefit>;
  lammps.input->one(kStyleVersion);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    if (lammps.num_ver == kLammps) {
      add_styles(lammps);
      lammps.input->file();
    } else {
      std::fprintf(stderr, "These styles were written for LAMMPS of version %d, as in Debian 12; liblammps is %d.\n",
                   kLammps, lammps.num_ver);
      status = 2;
    }
  }
  MPI_Finalize();
  return status;
}
