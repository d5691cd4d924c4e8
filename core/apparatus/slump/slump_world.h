#pragma once

#include "core/apparatus/slump/packing.h"
#include "core/world/world.h"

namespace pastefit {

/// Places of the walls in a slump test's world. The mould is the last one, and is gone after the lift.
inline constexpr std::size_t kTable = 0, kGround = 1, kMould = 2;

inline constexpr double kRestCap = 4;  ///< [s] simulated time a heap is allowed for coming to rest

/// The table, or the plate that can be dropped, on its seat: a square, or a disc where it falls upright.
Shape table_on_seat(const SlumpTest& test);

/// A packing in its mould on the table, under the laws of `test`. Grains that flow over the table's edge land on the
/// ground below it.
World world_in_mould(const SlumpTest& test, const Packing& packing);

}  // namespace pastefit
