// Reads a heap that another program left, as pastefit reads its own: read_heap CARD FILLED.dump HEAP.dump [HEAP2.dump]
// Dumps are LAMMPS's or LIGGGHTS's, with columns x y z radius in some order. Prints the readings of step 1, and of step
// 2 where its heap is given, as JSON.

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

/// The last picture of a dump, without the grains that fell off the table.
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
      if (centre.z < 0) continue;
      centres.push_back(centre);
      radii.push_back(radius);
    }
  }
  return make_particles(centres, radii, 1000);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: read_heap CARD FILLED.dump HEAP.dump [HEAP2.dump]\n");
    return 2;
  }
  const auto card = read_card(argv[1]);
  if (!card.ok()) {
    std::fprintf(stderr, "%s\n", message_of(card.faults()).c_str());
    return 2;
  }
  const auto& test = card.value().test;
  const double radius = test.grains.radius_m, probe = test.reading.probe_diameter_m, rim = test.mould.height_m;
  const Particles filled = read_dump(argv[2]);
  const double axis_zero = rim - height_at_axis(filled, radius, probe), highest_zero = rim - highest_point(filled);
  nlohmann::ordered_json out;
  for (int step = 1; step < argc - 2; ++step) {
    const Particles heap = read_dump(argv[step + 2]);
    if (filled.count() == 0 || heap.count() == 0) {
      std::fprintf(stderr, "the dumps hold %d and %d grains\n", static_cast<int>(filled.count()),
                   static_cast<int>(heap.count()));
      return 2;
    }
    const std::string name = "step" + std::to_string(step);
    out[name + ".height_axis_mm"] = 1e3 * (axis_zero + height_at_axis(heap, radius, probe));
    out[name + ".height_max_mm"] = 1e3 * (highest_zero + highest_point(heap));
    out[name + ".spread_mm"] = 1e3 * spread_diameter(heap, radius);
    if (step == 2) out["step2.plateau_sag_mm"] = 1e3 * plateau(heap, radius, probe, 0.5 * test.table_length_m).sag;
  }
  std::cout << out.dump() << "\n";
}
