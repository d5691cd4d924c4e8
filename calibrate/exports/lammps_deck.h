#pragma once

#include <string>
#include <vector>

#include "calibrate/exports/export.h"

namespace pastefit {

/// Two size classes and their interaction in LAMMPS's words.
struct LammpsPair {
  int first = 1, second = 1;  ///< atom types
  std::string granular;       ///< arguments of "pair_coeff i j granular"
  std::string table;          ///< keyword in attraction.table; empty: no attraction
  double cutoff_m = 0;        ///< where the table ends
};

struct LammpsDeck {
  std::vector<LammpsPair> pairs;
  std::string mould_wall, table_wall;  ///< arguments of "fix wall/gran granular"
  int table_points = 0;
};

/// Step 1 of the slump test: relax in the mould, lift, rest. Notes become comments.
std::string slump_deck(const ExportScene& scene, const LammpsDeck& deck, const std::vector<std::string>& notes);

/// Two grains of the first class at distances from an overlap of a twentieth of their radius to beyond rupture; prints
/// "pair DISTANCE FORCE" for each, repulsion positive.
std::string two_grains_deck(const ExportScene& scene, const LammpsDeck& deck);

/// The filled mould: id, type, diameter, density, position.
std::string grains_data(const ExportScene& scene);

/// Tenth of the Rayleigh time of the smallest grain [s], rounded down to two digits: pi R sqrt(rho/G)/(0.1631 nu +
/// 0.8766).
double deck_time_step_s(const ExportScene& scene);

}  // namespace pastefit
