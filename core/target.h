#pragma once

/// The type of processor that this is compiled for: the only place that asks.
///
/// x86-64 has contact kernels for SSE2, AVX2 and AVX-512. Any other processor has the kernels of four lanes, in the
/// compiler's vectors, whose bits are those of SSE2. Intrinsics stand where the compiler's vectors are slower.
///
/// PASTEFIT_X86, PASTEFIT_SIMD128 (vectors of WebAssembly): 1 or 0. PASTEFIT_FOUR_LANES: what the processor calls
/// vectors of 16 bytes. PASTEFIT_PAUSE: tells the processor that the thread waits.
#if defined(__x86_64__)
#include <immintrin.h>
#define PASTEFIT_X86 1
#define PASTEFIT_SIMD128 0
#define PASTEFIT_FOUR_LANES "SSE2"
#define PASTEFIT_PAUSE() __builtin_ia32_pause()
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#define PASTEFIT_X86 0
#define PASTEFIT_SIMD128 1
#define PASTEFIT_FOUR_LANES "SIMD128"
#define PASTEFIT_PAUSE() static_cast<void>(0)
#elif defined(__aarch64__)
#define PASTEFIT_X86 0
#define PASTEFIT_SIMD128 0
#define PASTEFIT_FOUR_LANES "NEON"
#define PASTEFIT_PAUSE() __asm__ volatile("yield")
#else
#define PASTEFIT_X86 0
#define PASTEFIT_SIMD128 0
#define PASTEFIT_FOUR_LANES "portable"
#define PASTEFIT_PAUSE() static_cast<void>(0)
#endif
