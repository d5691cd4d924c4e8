#define PASTEFIT_ISA avx2
#define PASTEFIT_ISA_NAME "AVX2"
#define PASTEFIT_WIDTH 8
#include "core/step/contact_kernel.h"
