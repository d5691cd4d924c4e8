#pragma once

#include <filesystem>
#include <string>

#include "calibrate/card/card.h"

namespace pastefit {

/// The card as the text of its file, which `card_from_json` reads: what replaces a card is read back first.
/// Errors: why it could not be read.
Result<std::string> readable_text(const Card& card);

/// Replaces the file by the card, whole or not at all. Errors: those of `readable_text` and `write_atomically`; what
/// was there is then as it was.
Faults write_card(const std::filesystem::path& file, const Card& card);

}  // namespace pastefit
