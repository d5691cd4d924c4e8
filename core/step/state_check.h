#pragma once

#include <cstddef>
#include <vector>

#include "core/step/run.h"
#include "core/world/world.h"

namespace pastefit {

struct EnergySums;

// What a step relies on, of a state that was read (`StateReader`): every index leads to a grain, every list has its
// length, every number is finite and possible. Errors of all: throw `BadState`.

/// What no wait changes of a world: its grains but for their motion, and the kinds and sizes of its walls.
class Fixtures {
 public:
  explicit Fixtures(const World& world);

  /// The world has the same ones, and its grains and walls move as any could.
  void check(const World& world) const;

 private:
  struct Grain {
    double radius, inverse_mass, inverse_inertia;
    bool operator==(const Grain&) const = default;
  };
  static Grain grain_of(const Particles& particles, std::size_t i);

  std::vector<Grain> grains_;               ///< by identity
  std::vector<std::vector<double>> sizes_;  ///< of each wall, the first its kind
};

/// Blocks of the world's grains with their lists. `listed`: they are those of the world as it is, and not to be made
/// anew before the next step.
void check_pairs(const World& world, bool listed);

/// Whether a grain can be there [m].
bool is_in_laboratory(const float (&place)[3]);

/// Whether every one of the sums is an energy that there can be.
bool are_possible(const EnergySums& energies);

/// Whether every point of a curve is.
bool is_finite(const std::vector<CurvePoint>& points);

}  // namespace pastefit
