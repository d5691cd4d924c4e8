#pragma once

#include <string_view>
#include <vector>

#include "core/apparatus/reading_kind.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

/// The stages of a slump test.
inline constexpr int kFill = 0, kStep1 = 1, kStep2 = 2, kAfterDrops = 3;

/// Whether the apparatus asks for a reading that is taken on request only (`ReadingKind::on_request`).
bool is_asked_for(const SlumpTest& test, std::string_view reading);

/// Every reading of slump tests, in the order in which a simulation gives them; those that this one lacks say so.
std::vector<ReadingKind> reading_kinds(const SlumpTest& test);

}  // namespace pastefit
