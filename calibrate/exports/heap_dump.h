#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "calibrate/laboratory/test.h"
#include "core/observe/readings.h"
#include "core/result.h"
#include "core/step/run.h"
#include "core/world/particles.h"

namespace pastefit {

/// The largest dump that is read: some five million grains.
inline constexpr std::uintmax_t kLargestDump = 512u << 20;

/// The last snapshot of a text dump as LAMMPS and LIGGGHTS write it (`dump custom` with the columns id, x, y, z and
/// radius in any order, in metres), in the order of the grains' numbers. `name` is that of the file, for places.
/// Errors: no snapshot, a column or lines that are missing, a number that is none or not finite, a radius of 0 or less,
/// a grain that stands twice; the first twenty with their lines.
Result<Particles> parse_dump(std::string_view text, const std::string& name);

/// The same of a regular file of at most `kLargestDump`.
Result<Particles> read_dump(const std::filesystem::path& file);

/// What a ruler reads of heaps that another program left: readings of step 1 and, where there is a second heap, of
/// step 2. `filled` are the same grains in the mould before it was lifted, `packing` the seed that was exported;
/// without it the test's own; `fill`: how its mould is filled for the comparison. Errors: the test is no slump test;
/// the dumps hold other grains than each other, or than the card's mould (by a tenth of their number, or 5 % of their
/// mean radius, as in another unit), or none near the table.
Result<Readings> read_heaps(const Test& test, std::optional<std::uint64_t> packing, const Particles& filled,
                            std::span<const Particles> heaps, const RunOptions& fill = {});

}  // namespace pastefit
