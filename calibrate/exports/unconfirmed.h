#pragma once

#include "calibrate/card/card.h"
#include "calibrate/exports/export.h"

namespace pastefit {

/// A card that is not confirmed leaves pastefit only if the user accepts that. Error: it does not.
Faults unconfirmed_faults(const Card& card, bool accepted);

/// Writes why the card is not confirmed as the first line of every file about its material; nothing for one that is.
void mark_unconfirmed(const Card& card, Export& written);

}  // namespace pastefit
