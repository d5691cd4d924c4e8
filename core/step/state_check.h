#pragma once

#include <cstddef>
#include <vector>

#include "core/step/run.h"
#include "core/world/world.h"

namespace pastefit {

struct EnergySums;

// Checks what a step assumes of a state that was read (`StateReader`): every index is valid, every list has the right
// length, every number is finite and possible. Errors: all throw `BadState`.

/// Properties that waits never change: those of the grains except motion, and kinds and sizes of the walls.
class Fixtures {
 public:
  explicit Fixtures(const World& world);

  /// Checks that the world has the same grains and walls, and that their motion is possible.
  void check(const World& world) const;

 private:
  struct Grain {
    double radius, inverse_mass, inverse_inertia;
    bool operator==(const Grain&) const = default;
  };
  static Grain grain_of(const Particles& particles, std::size_t i);

  std::vector<Grain> grains_;               ///< by identity
  std::vector<std::vector<double>> sizes_;  ///< of each wall, preceded by its kind
};

/// Checks blocks of grains with their lists. `listed`: the lists are valid, and are not rebuilt before the next step.
void check_pairs(const World& world, bool listed);

/// True if a grain can be at this place [m].
bool is_in_laboratory(const float (&place)[3]);

/// True if all sums are possible energies.
bool are_possible(const EnergySums& energies);

/// True if all points of a curve are finite.
bool is_finite(const std::vector<CurvePoint>& points);

}  // namespace pastefit
