// Reads a heap that another program left, as pastefit reads its own: read_heap CARD FILLED.dump HEAP.dump
// Dumps are LAMMPS's or LIGGGHTS's, with columns x y z radius in some order. Prints the readings of step 1 as JSON.

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "calibrate/card/card.h"
#include "calibrate/study/fault_text.h"
#include "core/observe/heap.h"

using namespace pastefit;

namespace {

/// The last picture of a dump.
Particles read_dump(const char* file) {
  std::ifstream in(file);
  std::vector<Vec3> centres;
  std::vector<double> radii;
  std::vector<std::string> columns;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    if (line.starts_with("ITEM: ATOMS")) {
      centres.clear();
      radii.clear();
      columns.clear();
      words.ignore(12);
      for (std::string word; words >> word;) columns.push_back(word);
    } else if (line.starts_with("ITEM:")) {
      columns.clear();
    } else if (!columns.empty()) {
      Vec3 centre;
      double radius = 0;
      for (const auto& column : columns) {
        double value = 0;
        words >> value;
        if (column == "x") centre.x = value;
        if (column == "y") centre.y = value;
        if (column == "z") centre.z = value;
        if (column == "radius") radius = value;
      }
      centres.push_back(centre);
      radii.push_back(radius);
    }
  }
  return make_particles(centres, radii, 1000);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: read_heap CARD FILLED.dump HEAP.dump\n");
    return 2;
  }
  const auto card = read_card(argv[1]);
  if (!card.ok()) {
    std::fprintf(stderr, "%s\n", message_of(card.faults()).c_str());
    return 2;
  }
  const auto& test = card.value().test;
  const double radius = test.grains.radius_m, probe = test.reading.probe_diameter_m, rim = test.mould.height_m;
  const Particles filled = read_dump(argv[2]), heap = read_dump(argv[3]);
  if (filled.count() == 0 || heap.count() != filled.count()) {
    std::fprintf(stderr, "the dumps hold %d and %d grains\n", static_cast<int>(filled.count()),
                 static_cast<int>(heap.count()));
    return 2;
  }
  const double axis = rim - height_at_axis(filled, radius, probe) + height_at_axis(heap, radius, probe);
  const double highest = rim - highest_point(filled) + highest_point(heap);
  const nlohmann::ordered_json out{{"step1.height_axis_mm", 1e3 * axis},
                                   {"step1.height_max_mm", 1e3 * highest},
                                   {"step1.spread_mm", 1e3 * spread_diameter(heap, radius)}};
  std::cout << out.dump() << "\n";
}
