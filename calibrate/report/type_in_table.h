#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// A number as a person types it into a DEM program.
struct TypeInRow {
  std::string quantity;  ///< in the words of DEM manuals, e.g. "sliding friction"
  double value = 0;      ///< in `unit`
  std::string unit;      ///< "" of a ratio
  std::string remark;    ///< what to know when typing it; mostly empty
};

/// The numbers of one pair of surfaces, of the grains, or of the attraction.
struct TypeInGroup {
  std::string title;  ///< e.g. "Grain on grain: Hertz-Mindlin, rolling by spring and dashpot"
  std::vector<TypeInRow> rows;
};

/// Everything that another DEM program has to be told of a card's material, in SI with customary prefixes: the grains
/// and their density (with which a filled mould has the laboratory's bulk density), each pair of surfaces of the tests,
/// and the attraction for grains of the card's size. Surfaces of several tests are listed once each.
std::vector<TypeInGroup> type_in_table(const Card& card);

/// The viscous force of every pair of surfaces as lines: its formula, then each symbol in it.
std::vector<std::string> damping_law(NormalLaw law);

/// As many digits as a person types: five at most, "0.3" and not "0.30000".
std::string typed(double value);

/// The same as lines for a terminal of 80 columns.
std::string type_in_lines(const Card& card);

}  // namespace pastefit
