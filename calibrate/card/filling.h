#pragma once

#include "calibrate/card/card.h"

namespace pastefit {

/// The card's test with this packing, as the calibration filled its mould: stiffnesses that were free stand in the
/// middle of their bounds (search/evaluator.h). Its fill, and `card.test` run in it, repeat a run of the calibration.
SlumpTable filling_of(const Card& card, std::uint64_t packing);
/// The same for another test of the card.
SlumpTable filling_of(const Card& card, const SlumpTable& test, std::uint64_t packing);

}  // namespace pastefit
