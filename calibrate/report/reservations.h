#pragma once

#include <string>
#include <vector>

#include "calibrate/card/card.h"

namespace pastefit {

/// What speaks against a card although its readings may be within their tolerances, a clause each, the gravest first:
/// heaps that sheared off and whatever else a kind of test remarks on its runs; readings that are within their
/// tolerance only without their standard error; parameters that ended at a bound, or beyond what is plausible. Empty:
/// nothing.
std::vector<std::string> reservations_on(const Card& card);

}  // namespace pastefit
