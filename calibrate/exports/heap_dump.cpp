#include "calibrate/exports/heap_dump.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "calibrate/base/input_file.h"
#include "calibrate/base/text.h"
#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/ruler.h"

namespace pastefit {

namespace {

constexpr std::size_t kMostDumpFaults = 20;
constexpr double kFarthest = 1e3;  // [m]; larger than any slump test
constexpr std::array<std::string_view, 5> kDumpColumns{"id", "x", "y", "z", "radius"};
const std::string kDumpRemedy = "write it with \"dump ... custom ... id x y z radius\"";

std::vector<std::string_view> columns_of_line(std::string_view line) {
  std::vector<std::string_view> out;
  for (std::size_t end = 0;;) {
    const std::size_t begin = line.find_first_not_of(" \t\r", end);
    if (begin == std::string_view::npos) return out;
    end = std::min(line.find_first_of(" \t\r", begin), line.size());
    out.push_back(line.substr(begin, end - begin));
  }
}

/// Line-by-line parser of one snapshot.
class DumpReader {
 public:
  explicit DumpReader(const std::string& name) : name_(name) {}

  void take(std::string_view line) {
    ++line_;
    if (line.starts_with("ITEM:"))
      begin_item(line);
    else if (item_ == Item::count)
      read_count(line);
    else if (item_ == Item::grains)
      read_grain(columns_of_line(line));
  }

  bool full() const { return faults_.size() >= kMostDumpFaults; }

  Result<Particles> finish() {
    if (item_ == Item::grains) end_grains();
    if (!seen_ && faults_.empty())
      faults_.push_back({name_, "holds no line \"ITEM: ATOMS ...\": it is not a text dump of grains", kDumpRemedy});
    if (!faults_.empty()) return faults_;
    std::ranges::sort(grains_);  // by id, their first number
    std::vector<Vec3> centres;
    std::vector<double> radii;
    for (std::size_t k = 0; k < grains_.size(); ++k) {
      const auto& grain = grains_[k];
      if (k > 0 && grains_[k - 1][0] == grain[0])
        return Fault{name_, "holds grain " + shown(grain[0]) + " twice", "each grain once in a snapshot"};
      centres.push_back({grain[1], grain[2], grain[3]});
      radii.push_back(grain[4]);
    }
    return make_particles(centres, radii, 1000);
  }

 private:
  enum class Item { other, count, grains };

  void fault(const std::string& what, const std::string& remedy) {
    if (!full()) faults_.push_back({name_ + " line " + std::to_string(line_), what, remedy});
  }

  void begin_item(std::string_view line) {
    if (item_ == Item::grains) end_grains();
    const auto words = columns_of_line(line);
    item_ = Item::other;
    if (line.starts_with("ITEM: NUMBER OF ATOMS")) item_ = Item::count;
    if (line.starts_with("ITEM: TIMESTEP")) count_.reset();
    if (!line.starts_with("ITEM: ATOMS")) return;
    item_ = Item::grains;
    seen_ = true;
    grains_.clear();
    columns_ = words.size() - 2;
    for (std::size_t i = 0; i < kDumpColumns.size(); ++i) {
      const auto at = std::find(words.begin() + 2, words.end(), kDumpColumns[i]);
      if (at == words.end())
        fault("lacks the column " + std::string(kDumpColumns[i]), kDumpRemedy);
      else
        places_[i] = static_cast<std::size_t>(at - words.begin()) - 2;
    }
    readable_ = faults_.empty();
  }

  void read_count(std::string_view line) {
    const auto words = columns_of_line(line);
    const auto count = words.size() == 1 ? parsed_number<std::size_t>(words[0]) : std::nullopt;
    if (!count)
      fault("is not a number of atoms", "a whole number");
    else
      count_ = *count;
  }

  void read_grain(const std::vector<std::string_view>& words) {
    if (!readable_ || words.empty()) return;
    if (words.size() != columns_)
      return fault("holds " + std::to_string(words.size()) + " columns, the header " + std::to_string(columns_),
                   "a dump that was written to its end");
    std::array<double, kDumpColumns.size()> grain{};
    for (std::size_t i = 0; i < grain.size(); ++i) {
      const std::string_view word = words[places_[i]];
      const auto number = parsed_number<double>(word);
      const std::string column(kDumpColumns[i]);
      if (!number || !std::isfinite(*number)) return fault(column + " is " + in_quotes(word), "a finite number");
      grain[i] = *number;
      if (i == 0 && (grain[i] < 1 || grain[i] != std::floor(grain[i]) || grain[i] > 1e15))
        return fault("id is " + in_quotes(word), "a whole number from 1");
      if (i > 0 && std::abs(grain[i]) > kFarthest)
        return fault(column + " is " + in_quotes(word), "metres, at most 1000 from the origin");
    }
    if (grain[4] <= 0) return fault("radius is " + shown(grain[4]), "a radius above 0, in metres");
    grains_.push_back(grain);
  }

  void end_grains() {
    if (!readable_ || full()) return;
    if (grains_.empty() && faults_.empty()) fault("holds no grain", "a dump of the heap");
    if (count_ && faults_.empty() && *count_ != grains_.size())
      fault("ends after " + std::to_string(grains_.size()) + " grains of " + std::to_string(*count_),
            "a dump that was written to its end");
  }

  const std::string& name_;
  std::size_t line_ = 0, columns_ = 0;
  Item item_ = Item::other;
  bool seen_ = false, readable_ = false;
  std::optional<std::size_t> count_;
  std::array<std::size_t, kDumpColumns.size()> places_{};
  std::vector<std::array<double, kDumpColumns.size()>> grains_;
  Faults faults_;
};

}  // namespace

Result<Particles> parse_dump(std::string_view text, const std::string& name) {
  DumpReader reader(name);
  while (!text.empty() && !reader.full()) reader.take(next_line(text));
  return reader.finish();
}

Result<Particles> read_dump(const std::filesystem::path& file) {
  const auto text =
      read_input(file, {.largest_bytes = kLargestDump,
                        .remedy = "a text dump of the last heap, of LAMMPS, LIGGGHTS or the Yade script"});
  return text.ok() ? parse_dump(text.value(), printable(file.string())) : text.faults();
}

namespace {

/// Faults of grains in another size or unit than the card's, or away from the table.
Faults misplaced(const std::string& dump, const Particles& grains, const Packing& packing) {
  constexpr double size_room = 0.05, height_room = 2;  // of the mean radius
  double expected_m = 0, radius_m = 0, lowest_m = 1e300;
  for (const double radius : packing.radii) expected_m += radius / static_cast<double>(packing.radii.size());
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    radius_m += grains.motion[i].radius / grains.count();
    lowest_m = std::min(lowest_m, grains.motion[i].position.z - grains.motion[i].radius);
  }
  const double factor = radius_m / expected_m;
  if (std::abs(factor - 1) > size_room)
    return {{dump, "has grains about " + plain(factor, 2) + " times as large as the card's",
             "a dump in metres, of a deck that was exported from this card"}};
  if (lowest_m > height_room * expected_m)
    return {{dump, "begins " + shown(1e3 * lowest_m) + " mm above the table",
             "z upwards from the table, in metres, without grains that have fallen off"}};
  return {};
}

}  // namespace

Result<Readings> read_heaps(const Test& test, std::optional<std::uint64_t> packing_seed, const Particles& filled,
                            std::span<const Particles> heaps, const RunOptions& fill) {
  const auto* const slump = std::get_if<SlumpTest>(&test);
  if (!slump)
    return Fault{"the card's test", "is not a slump test: there is no heap to read", "a slump test with --test"};
  SlumpTest exported = *slump;
  exported.packing_seed = packing_seed.value_or(exported.packing_seed);
  Faults faults;
  for (const Particles& heap : heaps)
    if (heap.count() != filled.count())
      faults.push_back({"dumps",
                        "hold " + std::to_string(filled.count()) + " grains in the mould and " +
                            std::to_string(heap.count()) + " in the heap",
                        "give the dump of the same run with --filled; grains must not be lost"});
  const auto packing = fill_mould(exported, fill);
  if (packing->failure) faults.push_back({"the mould of the card", packing->failure->message, "another --packing"});
  const auto expected = static_cast<double>(packing->centres.size());
  const auto count = static_cast<double>(filled.count());
  if (!packing->failure && std::abs(count - expected) > 0.1 * expected)
    faults.push_back({"the filled mould", "holds " + shown(count) + " grains, that of the card " + shown(expected),
                      "give the card from which the deck was exported"});
  if (!faults.empty()) return faults;
  faults = misplaced("the filled mould", filled, *packing);
  for (std::size_t step = 0; step < heaps.size(); ++step)
    append(faults, misplaced("the heap of step " + std::to_string(step + 1), heaps[step], *packing));
  if (!faults.empty()) return faults;
  const Ruler ruler(exported, packing->roughness_m, filled);
  Readings readings;
  for (std::size_t step = 0; step < heaps.size(); ++step)
    ruler.read(heaps[step], "step" + std::to_string(step + 1), readings);
  return readings;
}

}  // namespace pastefit
