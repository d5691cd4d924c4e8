#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// Value for manual input into a DEM program.
struct TypeInRow {
  std::string quantity;  ///< in the terms of DEM manuals, e.g. "sliding friction"
  double value = 0;      ///< in `unit`
  std::string unit;      ///< "" for ratios
  std::string remark;    ///< advice; mostly empty
};

/// Values of one pair of surfaces, of the grains, or of the attraction.
struct TypeInGroup {
  std::string title;  ///< e.g. "Grain on grain: Hertz-Mindlin, rolling by spring and dashpot"
  std::vector<TypeInRow> rows;
};

/// All values of a card's material that another DEM program needs, in SI with customary prefixes: grains and their
/// density (which gives the measured bulk density in a filled mould), each pair of surfaces of the tests, and the
/// attraction for grains of the card's size. Surfaces of several tests are listed once.
std::vector<TypeInGroup> type_in_table(const Card& card);

/// Viscous force for every pair of surfaces as lines: formula, then each symbol.
std::vector<std::string> damping_law(NormalLaw law);

/// At most five digits: "0.3", not "0.30000".
std::string typed(double value);

/// The table as lines for a terminal of 80 columns.
std::string type_in_lines(const Card& card);

}  // namespace pastefit
