#define PASTEFIT_ISA avx512
#define PASTEFIT_ISA_NAME "AVX-512"
#define PASTEFIT_WIDTH 16
#include "core/step/contact_kernel.h"
