#pragma once

#include <string>
#include <string_view>

namespace pastefit {

/// Chooses the kernels of runs whose `StepOptions` name none: those of "sse2", "avx2" or "avx512" instead of the widest
/// that this processor runs. Returns false, and changes nothing, if it does not run them. Requirement: no run is under
/// way. The bits of SSE2 differ from those of the others (core/README.md, Determinism).
bool use_kernels(std::string_view instruction_set);

/// The words that `use_kernels` takes on this processor, the widest first: "avx512, avx2, sse2".
std::string usable_kernels();

}  // namespace pastefit
