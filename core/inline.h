#pragma once

/// Everything a kernel calls is inlined into it: an out-of-line copy compiled for AVX-512 could be picked by the linker
/// for the whole program and stop an older processor.
#define PASTEFIT_INLINE [[gnu::always_inline]] inline
