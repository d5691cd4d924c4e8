#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace pastefit {

/// Allocates on cache lines, so that loads of packs do not cross one.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
  bool operator==(const CacheLineAllocator&) const { return true; }
};

template <class T>
using Column = std::vector<T, CacheLineAllocator<T>>;

/// Pairs per batch. A batch is a structure of arrays in which each field of 16 floats is one cache line, so that a
/// kernel reads one stream of whole lines. Lists are padded with pairs of the dummy grain with itself.
inline constexpr int kBatch = 16;

/// Pairs that touch or may touch before the next selection, 56 bytes a pair. The history is explained with
/// `ContactHistory` in core/laws/contact_kinematics.h.
struct alignas(64) ContactBatch {
  std::int32_t i[kBatch], j[kBatch];             ///< j unused with a wall
  float sqrt_radius[kBatch], sqrt_mass[kBatch];  ///< of the effective radius and mass
  float slip[3][kBatch], roll[3][kBatch];
  float sqrt_contact_radius[kBatch], damper[kBatch], drag[kBatch], bond[kBatch];
};

/// Pairs that attract each other across a gap, or may do so, but cannot touch before the next selection: only their
/// distance is needed.
struct alignas(64) BridgeBatch {
  std::int32_t i[kBatch], j[kBatch];
  float size_scale[kBatch], bond[kBatch];
};

/// Additional data of a batch of contacts with a wall.
struct alignas(64) WallBatch {
  float normal[3][kBatch], wall_velocity[3][kBatch];  ///< at the point of the wall nearest to the grain
  float overlap[kBatch];
  float force[3][kBatch], moment[3][kBatch];  ///< of the wall on the grain, written by the kernel
  float damping[kBatch], stiffness[kBatch];
};

}  // namespace pastefit
