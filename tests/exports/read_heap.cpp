// Reads a heap that another program left, as pastefit reads its own: read_heap CARD PACKING FILLED.dump HEAP.dump
// [HEAP2.dump]. Dumps are LAMMPS's or LIGGGHTS's, with columns id x y z radius in some order. Prints the readings of
// step 1, and of step 2 where its heap is given, as JSON. Both programs' heights hold the same roughness of the
// packing.

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "calibrate/base/fault_text.h"
#include "calibrate/card/card.h"
#include "calibrate/exports/export.h"
#include "core/rigs/slump/packing.h"
#include "core/rigs/slump/ruler.h"

using namespace pastefit;

namespace {

/// The last picture of a dump, in the order of the grains' numbers.
Particles read_dump(const char* file) {
  struct Grain {
    Vec3 centre;
    double radius = 0;
  };
  std::ifstream in(file);
  std::map<long, Grain> grains;
  std::vector<std::string> columns;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    if (line.starts_with("ITEM: ATOMS")) {
      grains.clear();
      columns.clear();
      words.ignore(12);
      for (std::string word; words >> word;) columns.push_back(word);
    } else if (line.starts_with("ITEM:")) {
      columns.clear();
    } else if (!columns.empty()) {
      Grain grain;
      long number = 0;
      for (const auto& column : columns) {
        double value = 0;
        words >> value;
        if (column == "id") number = std::lround(value);
        if (column == "x") grain.centre.x = value;
        if (column == "y") grain.centre.y = value;
        if (column == "z") grain.centre.z = value;
        if (column == "radius") grain.radius = value;
      }
      grains[number] = grain;
    }
  }
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (const auto& [number, grain] : grains) {
    centres.push_back(grain.centre);
    radii.push_back(grain.radius);
  }
  return make_particles(centres, radii, 1000);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 && argc != 6) {
    std::fprintf(stderr, "usage: read_heap CARD PACKING FILLED.dump HEAP.dump [HEAP2.dump]\n");
    return 2;
  }
  const auto card = read_card(argv[1]);
  if (!card.ok()) {
    std::fprintf(stderr, "%s\n", message_of(card.faults()).c_str());
    return 2;
  }
  const auto exported = test_to_export(card.value(), "");
  if (!exported.ok()) {
    std::fprintf(stderr, "%s\n", message_of(exported.faults()).c_str());
    return 2;
  }
  auto test = std::get<SlumpTest>(exported.value().test);
  test.packing_seed = std::stoull(argv[2]);
  const Particles filled = read_dump(argv[3]);
  const Ruler ruler(test, fill_mould(test)->roughness_m, filled);
  nlohmann::ordered_json out;
  for (int step = 1; step < argc - 3; ++step) {
    const Particles heap = read_dump(argv[step + 3]);
    if (filled.count() == 0 || heap.count() != filled.count()) {
      std::fprintf(stderr, "the dumps hold %d and %d grains\n", static_cast<int>(filled.count()),
                   static_cast<int>(heap.count()));
      return 2;
    }
    Observables readings;
    ruler.read(heap, "step" + std::to_string(step), readings);
    for (const Observable& reading : readings.all()) out[reading.name] = reading.value;
  }
  std::cout << out.dump() << "\n";
}
