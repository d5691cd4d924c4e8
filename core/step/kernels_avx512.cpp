#define PASTEFIT_ISA avx512
#define PASTEFIT_ISA_NAME "AVX-512"
#define PASTEFIT_WIDTH 8  // as AVX2: twice its registers, and masks
#include "core/step/contact_kernel.h"
