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

/// Size limit of dumps: about five million grains.
inline constexpr std::uintmax_t kLargestDump = 512u << 20;

/// Parses the last snapshot of a text dump of LAMMPS or LIGGGHTS (`dump custom` with the columns id, x, y, z and radius
/// in any order, in metres), sorted by id. `name`: file name for places. Errors, at most twenty, with their lines: no
/// snapshot, missing columns or lines, an invalid or infinite number, a radius of 0 or less, a duplicate grain.
Result<Particles> parse_dump(std::string_view text, const std::string& name);

/// Reads a dump from a regular file of at most `kLargestDump`.
Result<Particles> read_dump(const std::filesystem::path& file);

/// Reads heaps of another program: readings of step 1 and, with a second heap, of step 2. `filled`: the same grains in
/// the mould before the lift. `packing`: the exported seed; default: the test's own. `fill`: options of the filling for
/// the comparison. Errors: the test is not a slump test; the dumps differ in their grains from each other, or from the
/// card's mould (by a tenth of the number, or 5 % of the mean radius, e.g. by another unit); no grain is near the
/// table.
Result<Readings> read_heaps(const Test& test, std::optional<std::uint64_t> packing, const Particles& filled,
                            std::span<const Particles> heaps, const RunOptions& fill = {});

}  // namespace pastefit
