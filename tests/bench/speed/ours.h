#pragma once

#include <cstdint>

#include "core/step/kernels.h"
#include "core/step/stage_clock.h"
#include "core/world/world.h"
#include "tests/bench/speed/scene.h"

namespace pastefit {

/// What our engine did with a scene.
struct OurRun {
  double seconds = 0;  ///< of the processor, over the timed steps
  StageClock stages;   ///< of the same steps
  double grains = 0;
  double advised_step_s = 0;  ///< the largest step our engine would have taken, at the worst moment
  double contacts = 0;        ///< a grain, at the end: pairs worked on in full
  double bridges = 0;         ///< a grain, at the end: pairs that only attract each other
};

/// Steps the scene as every engine does: at `kSceneStep`, the warm steps first, then the timed ones.
/// `energy_balance`: of energy; no other engine keeps one, and the search's candidates keep none either.
/// `kernels`: those of an instruction set that this processor has.
/// The bed is used up, so that its memory does not count as the engine's.
/// Errors: throws std::runtime_error if the run fails.
OurRun run_ours(const Scene& scene, Bed&& bed, bool energy_balance, const KernelTable& kernels);

/// The scene's world at rest, ready to be stepped.
World world_of(const Scene& scene, Bed&& bed);

}  // namespace pastefit
