#pragma once

/// Forces inlining of everything that a kernel calls: the linker could choose an out-of-line copy compiled for AVX-512
/// for the whole program, which would crash on an older processor.
#define PASTEFIT_INLINE [[gnu::always_inline]] inline
