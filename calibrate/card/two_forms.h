#pragma once

#include "calibrate/card/card.h"

namespace pastefit {

/// A card holds its contact laws twice: scale-free (`Material::parameters`) and in SI, for the material's grains and
/// those of its tests. Every number of the SI form that the scale-free one does not give, to nine digits: a card that
/// was edited by hand in one place.
Faults differing_forms(const Card& card);

}  // namespace pastefit
