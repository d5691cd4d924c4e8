#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/laws/contact.h"
#include "core/laws/table.h"
#include "core/world/batches.h"
#include "core/world/domain.h"
#include "core/world/particles.h"
#include "core/world/selection.h"
#include "core/world/walls.h"

namespace pastefit {

/// A stretch of a list's batches: pairs that touched when they were chosen, then (from `near`) pairs that may touch. A
/// batch of pairs that may touch is computed in full only if one of its pairs touches.
struct Stretch {
  std::int32_t begin, near, end;
};

/// Energies of a step, summed in eight lanes by the contact's place in its half of a batch, so that every instruction
/// set sums alike.
struct alignas(64) EnergySums {
  enum Kind { normal_damping, sliding, rolling, bridges, viscous, plastic, stored, kinds };
  static constexpr int kLanes = 8;
  double lane[kinds][kLanes] = {};
  void forget(Kind kind) {
    for (double& value : lane[kind]) value = 0;
  }
};
double total(std::span<const EnergySums> shares, EnergySums::Kind kind);

struct KernelTask {
  const Motion* motion;
  Load* load;  ///< pair kernels add to it; wall kernels write their columns instead
  ContactBatch* contacts;
  BridgeBatch* bridges;
  WallBatch* wall;  ///< beside `contacts`
  Stretch stretch;
  Domain domain;
  PairConstants pair;
  double dt;
  EnergySums* energy;
  Energies energies;
  bool fetches_ahead;  ///< prefetch the next batches: faster if grains and lists do not fit into the cache
};

constexpr double kRunawaySpeed = 100;  // [m/s]; nothing in a laboratory test comes near it

/// Grains near a wall, for which the nearest point of the wall is wanted.
struct WallTask {
  const Motion* motion;
  const ContactBatch* contacts;
  WallBatch* batches;  ///< where they are, how the wall moves there, and the overlap: written
  std::int32_t count;  ///< contacts, without the padding
  const Wall* wall;
  double overlap_limit;  ///< over the radius of a grain
};

/// Finds the nearest points; returns a grain that is deeper in the wall than the limit, or -1. `shape`: the wall's.
template <class Shape>
using FindOnWall = std::int32_t (*)(const WallTask&, const Shape& shape);

/// The grains of a block, to be moved by a step.
struct MoveTask {
  Motion* motion;
  Velocity* velocity;
  Load* load;                       ///< used up: zero afterwards
  const DisplacementBound* bounds;  ///< where the lists allow them to be
  std::int32_t grains, grains_end;
  double dt;    ///< [s]
  double kick;  ///< from the half step before to the half step after [s]
  double gravity, drag;
};

/// Summary of the motion of some grains in a step.
struct Moved {
  double fastest_square = 0;    ///< [m^2/s^2]
  double stiffest = 0;          ///< stiffness over mass [1/s^2]
  double dissipation_drag = 0;  ///< [J]
  bool exceeded = false;        ///< a grain has exceeded its bound, or its position is not a number
  std::int32_t runaway = -1;    ///< a grain with an impossible speed, or one that is not a number
};

/// Laws are composed at compile time: one function per combination, chosen once per run.
using Kernel = void (*)(const KernelTask&);

inline constexpr std::size_t kCombinations = NormalLaws::size * Attractions::size * RollingLaws::size;

/// Kernels of one kind, by `combination`; empty where laws cannot be combined.
using Kernels = std::array<Kernel, kCombinations>;

/// Index of the kernels of these laws in the table.
constexpr std::size_t combination(NormalLaw normal, BridgeShape attraction, RollingModel rolling) {
  return (row_of(normal) * Attractions::size + row_of(attraction)) * RollingLaws::size + row_of(rolling);
}

struct KernelTable {
  Kernels pair, wall;
  Kernels viscous_pair, viscous_wall;  ///< of bridges that have a viscosity; no other pairs attract each other
  std::array<Kernel, Attractions::size> bridge;  ///< pairs that cannot touch; empty where there is no attraction
  std::tuple<FindOnWall<Plane>, FindOnWall<Plate>, FindOnWall<Shell>, FindOnWall<Ribs>> find_on_wall;
  FindNear find_near;
  FindNearness find_nearness;
  Moved (*move)(const MoveTask&);
  std::string_view instruction_set;
};

/// Of every processor: vectors of 16 bytes.
namespace four_lanes {
extern const KernelTable kernels;
}
/// Of x86-64 only.
namespace avx2 {
extern const KernelTable kernels;
}
namespace avx512 {
extern const KernelTable kernels;
}

/// The kernels this processor runs, the widest first.
std::vector<const KernelTable*> kernels_this_processor_runs();
/// The widest kernels that this processor runs.
const KernelTable& kernels_of_this_processor();

/// Chooses the kernels of runs whose `StepOptions` name none: those of "sse2", "avx2" or "avx512" instead of the widest
/// that this processor runs. Returns false, and changes nothing, if the processor does not run these. Requirement: no
/// run is under way. Other processors than x86-64 have one word: "neon" on AArch64, "simd128" in WebAssembly. The bits
/// of four lanes differ from those of AVX2 and AVX-512 (core/README.md, Determinism).
bool use_kernels(std::string_view instruction_set);

/// The words that `use_kernels` takes on this processor, the widest first: "avx512, avx2, sse2".
std::string usable_kernels();

}  // namespace pastefit
