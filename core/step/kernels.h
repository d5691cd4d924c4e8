#pragma once

#include <cstdint>
#include <string_view>

#include "core/laws/constants.h"
#include "core/rigs/materials.h"
#include "core/world/particles.h"

namespace pastefit {

/// Columns of contacts or bridges (which leave most empty) as a kernel sees them: plain pointers, begin .. end a
/// multiple of kBatch, 64-byte aligned.
struct ContactView {
  const std::int32_t *i, *j;
  const double *root_radius, *root_mass, *inverse_mass, *size_scale;
  double *slip[3], *roll[3], *root_contact_radius, *damper, *drag, *bridge;
  std::int32_t count;
};

/// What a wall kernel reads and writes besides.
struct WallView {
  const double *normal[3], *wall_velocity[3], *overlap;
  double *force[3], *moment[3], *damping, *stiffness;
};

/// Energies of a step, summed in eight lanes by the contact's place in its batch, so that every instruction set sums
/// alike.
struct alignas(64) EnergySums {
  enum Kind { normal_damping, sliding, rolling, bridges, stored, kinds };
  double lane[kinds][8] = {};
  double total(Kind kind) const;
};

struct KernelTask {
  const Motion* motion;
  const Spin* spin;
  Load* load;  ///< pair kernels add to it; wall kernels write their columns instead
  ContactView contacts;
  WallView wall;
  PairConstants pair;
  double dt;
  EnergySums* energy;
  bool with_stored;  ///< the energy stored is wanted in this step: it costs the work of every bridge
};

/// Laws are composed at compile time: one function per combination, chosen once per run.
using Kernel = void (*)(const KernelTask&);

/// Kernels by attraction (none, polynomial, exponential, capillary) and rolling (none, spring-dashpot, constant
/// torque).
struct KernelTable {
  Kernel pair[4][3];
  Kernel wall[4][3];
  Kernel bridge[4];  ///< pairs that cannot touch; empty where there is no attraction
  std::string_view instruction_set;
};

namespace sse2 {
extern const KernelTable kernels;
}
namespace avx2 {
extern const KernelTable kernels;
}
namespace avx512 {
extern const KernelTable kernels;
}

/// The widest kernels this processor runs. All tables give the same bits.
const KernelTable& kernels_of_this_processor();

/// Columns of the table.
int attraction_index(BridgeShape shape);
int rolling_index(RollingModel rolling);

}  // namespace pastefit
